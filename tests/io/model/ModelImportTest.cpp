// Models of other formats become layers: geometry, frames, names.
#include "io/model/ModelImport.h"

#include "tests/io/model/LayerParts.h"
#include "tests/io/usd/UsdTestFiles.h"
#include "tests/support/ModelTexts.h"

#include <gmock/gmock.h>

namespace penumbra {

namespace {

using testing::ElementsAre;

class ModelImport : public testing::Test {
protected:
    TemporaryFolder here;

    ImportedModel import(const std::string& name, const std::string& text,
                         const ImportOptions& options = {}) {
        return importModel(here.write(name, text), options);
    }
};

TEST_F(ModelImport, ColladaSaysItsUnitAndItsUpAxis) {
    const auto model = import(
        "a.dae", colladaText(R"(<unit name="inch" meter="0.0254"/><up_axis>Z_UP</up_axis>)"));
    EXPECT_EQ(numberIn(model.layer.metadata, "metersPerUnit"), 0.0254);
    EXPECT_EQ(textIn(model.layer.metadata, "upAxis"), "Z");
    EXPECT_EQ(primAt(model.layer, "/a")->property("xformOp:transform"), nullptr);
    EXPECT_THAT(numbersOf(model.layer, "/a/Table", "xformOp:transform"),
                ElementsAre(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 2, 0, 0, 1));
}

TEST_F(ModelImport, WordsElsewhereInColladaSayNothingOfItsAxis) {
    const auto model =
        import("a.dae", colladaText("<title>Z_UP, meter=3</title><unit name=\"m\"/>"));
    EXPECT_EQ(textIn(model.layer.metadata, "upAxis"), "Y");
    EXPECT_EQ(numberIn(model.layer.metadata, "metersPerUnit"), 1);
}

TEST_F(ModelImport, AnUpAxisThatUsdDoesNotHaveIsTurned) {
    import("a.dae", colladaText("<up_axis>X_UP</up_axis>"));
    const LoadedScene scene = loadUsdScene(here.file("a.dae"));
    const auto nodes = nodesByPath(*scene.scene);
    const PlacedNode* table = leafOf(nodes, "/a/Table/square");
    ASSERT_TRUE(table && table->mesh());
    const glm::dvec3 origin = glm::dvec3(table->toWorld[3]);
    EXPECT_NEAR(origin.y, 2, 1e-9); // it was at X = 2
    EXPECT_NEAR(origin.x, 0, 1e-9);
}

TEST_F(ModelImport, WhatHasNoUnitIsInMetresUnlessOneIsGiven) {
    const std::string text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n";
    const auto model = import("a.obj", text);
    EXPECT_EQ(numberIn(model.layer.metadata, "metersPerUnit"), 1);
    EXPECT_EQ(textIn(model.layer.metadata, "upAxis"), "Y");
    EXPECT_TRUE(says(model, "taken as metres, Y up"));
    const auto given = import("a.obj", text, {.metersPerUnit = 0.001, .up = UpAxis::z});
    EXPECT_EQ(numberIn(given.layer.metadata, "metersPerUnit"), 0.001);
    EXPECT_EQ(textIn(given.layer.metadata, "upAxis"), "Z");
    EXPECT_FALSE(says(given, "taken as"));
    EXPECT_EQ(textIn(import("a.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n"
                                     "vertex 1 0 0\nvertex 1 1 0\nendloop\nendfacet\nendsolid\n")
                         .layer.metadata,
                     "upAxis"),
              "Z");
}

TEST_F(ModelImport, TrianglesOfGltfWithoutNormalsAreFlatAsItsSpecificationAsks) {
    const auto model = import("a.gltf", gltfText(R"([{"name": "Tile", "mesh": 0}])"));
    EXPECT_THAT(numbersOf(model.layer, "/a/Tile/Square", "normals"), ElementsAre(0, 1, 0, 0, 1, 0));
    EXPECT_EQ(interpolationOf(model.layer, "/a/Tile/Square", "normals"), "uniform");
}

TEST_F(ModelImport, FacetsOfStlLeaveTheSurfaceToTheScene) {
    const auto model = import("a.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n"
                                       "vertex 1 0 0\nvertex 1 1 0\nendloop\nendfacet\nendsolid\n");
    EXPECT_THAT(numbersOf(model.layer, "/a/a/a", "faceVertexCounts"), ElementsAre(3));
    EXPECT_TRUE(numbersOf(model.layer, "/a/a/a", "normals").empty());
}

TEST_F(ModelImport, PolygonsStayPolygonsAndTheirCornersShareAPoint) {
    const auto model = import("a.obj", "o Roof\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\n"
                                       "v 3 0.5 0\nv 2 1 0\nvn 0 0 1\nvt 0 0\nvt 1 0\nvt 1 1\n"
                                       "f 1/1/1 2/2/1 3/3/1 4/1/1\n"
                                       "f 2/3/1 5/1/1 6/1/1 7/1/1 3/1/1\n");
    const std::string roof = "/a/Roof/Roof";
    EXPECT_THAT(numbersOf(model.layer, roof, "faceVertexCounts"), ElementsAre(4, 5));
    EXPECT_THAT(numbersOf(model.layer, roof, "faceVertexIndices"),
                ElementsAre(0, 1, 2, 3, 1, 4, 5, 6, 2));
    EXPECT_EQ(numbersOf(model.layer, roof, "points").size(), 7u * 3);
    EXPECT_EQ(interpolationOf(model.layer, roof, "normals"), "vertex"); // all of them agree
    EXPECT_EQ(interpolationOf(model.layer, roof, "primvars:st"), "faceVarying");
    EXPECT_EQ(numbersOf(model.layer, roof, "primvars:st").size(), 9u * 2);
    EXPECT_EQ(textOf(model.layer, roof, "subdivisionScheme"), "none");
}

TEST_F(ModelImport, ColoursOfVerticesAreShown) {
    const auto model = import("a.ply", "ply\nformat ascii 1.0\nelement vertex 3\n"
                                       "property float x\nproperty float y\nproperty float z\n"
                                       "property uchar red\nproperty uchar green\n"
                                       "property uchar blue\nelement face 1\n"
                                       "property list uchar int vertex_index\nend_header\n"
                                       "0 0 0 255 0 0\n1 0 0 255 0 0\n1 1 0 255 0 0\n3 0 1 2\n");
    const std::string mesh = "/a/a/Mesh";
    EXPECT_THAT(numbersOf(model.layer, mesh, "primvars:displayColor"),
                ElementsAre(1, 0, 0, 1, 0, 0, 1, 0, 0));
    EXPECT_EQ(interpolationOf(model.layer, mesh, "primvars:displayColor"), "vertex");
    EXPECT_EQ(primAt(model.layer, mesh)->property("material:binding"), nullptr);
}

TEST_F(ModelImport, NamesBecomeValidAndUniqueAndAreKeptForPeople) {
    const auto model =
        import("2 rooms.gltf",
               gltfText(R"([{"name": "Möbel", "children": [1, 2, 3]}, {"name": "leg.1", "mesh": 0},
                     {"name": "leg 1", "mesh": 0}, {"name": "2nd \"leg\"", "mesh": 0}])"));
    const UsdPrimSpec& root = model.layer.prims.front();
    EXPECT_EQ(root.name, "_2_rooms");
    EXPECT_EQ(textIn(root.metadata, "displayName"), "2 rooms");
    EXPECT_EQ(textIn(model.layer.metadata, "defaultPrim"), "_2_rooms");
    const UsdPrimSpec& furniture = root.children.front();
    EXPECT_EQ(furniture.name, "M_bel");
    EXPECT_EQ(textIn(furniture.metadata, "displayName"), "Möbel");
    ASSERT_EQ(furniture.children.size(), 3u);
    EXPECT_EQ(furniture.children[0].name, "leg_1");
    EXPECT_EQ(furniture.children[1].name, "leg_1_1");
    EXPECT_EQ(furniture.children[2].name, "_2nd__leg_");
    EXPECT_EQ(textIn(furniture.children[2].metadata, "displayName"), "2nd \"leg\"");
    EXPECT_EQ(differenceAfterWriting(model.layer), "");
}

TEST_F(ModelImport, NodesKeepTheirHierarchyAndTheirPlaces) {
    const std::string text =
        gltfText(R"([{"name": "House", "translation": [10, 0, 0], "children": [1, 3]},
                     {"name": "Table", "scale": [2, 2, 2], "mesh": 0, "children": [2]},
                     {"name": "Cup", "translation": [0, 1, 0], "mesh": 0},
                     {"name": "Desk", "rotation": [0, 0.70710678, 0, 0.70710678], "mesh": 0}])");
    const auto model = import("a.gltf", text);
    EXPECT_EQ(textIn(primAt(model.layer, "/a/House")->metadata, "kind"), "group");
    EXPECT_EQ(textIn(primAt(model.layer, "/a/House/Table")->metadata, "kind"), "component");
    EXPECT_EQ(textIn(primAt(model.layer, "/a/House/Table/Cup")->metadata, "kind"), "subcomponent");
    EXPECT_EQ(model.meshes, 3u); // one mesh, on three nodes
    const LoadedScene scene = loadUsdScene(here.file("a.gltf"));
    const auto nodes = nodesByPath(*scene.scene);
    const PlacedNode* cup = leafOf(nodes, "/a/House/Table/Cup/Square");
    ASSERT_TRUE(cup && cup->mesh());
    EXPECT_EQ(glm::dvec3(cup->toWorld[3]), glm::dvec3(10, 2, 0));
    EXPECT_NEAR(surfaceArea(*cup->mesh(), cup->toWorld), 4, 1e-6);
    const PlacedNode* desk = leafOf(nodes, "/a/House/Desk/Square");
    ASSERT_TRUE(desk);
    EXPECT_NEAR(
        glm::distance(glm::dvec3(desk->toWorld * glm::dvec4(1, 0, 0, 1)), glm::dvec3(10, 0, -1)), 0,
        1e-6); // a quarter turn about Y takes X to -Z
}

TEST_F(ModelImport, WhatIsLeftOutIsNamed) {
    const auto model = import("a.obj", "o Thing\nv 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\nl 1 2\n");
    EXPECT_TRUE(says(model, "points and lines left out"));
    EXPECT_EQ(model.faces, 1u);
}

TEST_F(ModelImport, AModelIsASublayerAsWell) {
    here.write("box.obj", "o Box\nv 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n");
    const auto over = here.write("over.usda", "#usda 1.0\n(\n    metersPerUnit = 1\n"
                                              "    subLayers = [@./box.obj@]\n)\n"
                                              "def SphereLight \"Bulb\"\n{\n}\n");
    const LoadedScene scene = loadUsdScene(over);
    const auto nodes = nodesByPath(*scene.scene);
    EXPECT_TRUE(leafOf(nodes, "/box/Box/Box"));
    EXPECT_TRUE(leafOf(nodes, "/Bulb"));
    EXPECT_THAT(scene.files, testing::Contains(here.path() / "./box.obj"));
}

} // namespace

} // namespace penumbra
