// PointInstancers, and instanceable prims: many places of one thing.
#include "scenegraph/Objects.h"
#include "scenegraph/Transform.h"
#include "tests/io/usd/UsdTestFiles.h"

#include <gtest/gtest.h>

#include <fstream>
#include <set>

namespace penumbra {

namespace {

constexpr const char* kMetres = "(\n metersPerUnit = 1\n)\n";
constexpr const char* kChairs = "  rel prototypes = </I/Prototypes/Chair>\n";
constexpr const char* kPrototypes = "  over \"Prototypes\"\n  {\n   def Xform \"Chair\"\n   {\n    "
                                    "double3 xformOp:translate = (0, 0, "
                                    "1)\n    uniform token[] xformOpOrder = "
                                    "[\"xformOp:translate\"]\n    def Cube \"Seat\"\n    {\n   "
                                    " }\n   }\n   def Sphere \"Ball\"\n   {\n   }\n  }\n";

LoadedScene loadInstancer(const std::string& attributes, const LoadOptions& options = {}) {
    return loadText(std::string(kMetres) + "def PointInstancer \"I\"\n{\n" + attributes +
                        kPrototypes + "}\n",
                    options);
}

std::vector<Placed<Mesh>> meshesOf(const LoadedScene& loaded) {
    return placeScene(*loaded.scene).meshes;
}

glm::vec3 at(const Placed<Mesh>& mesh, glm::vec3 point) {
    return glm::vec3(mesh.toWorld * glm::dvec4(glm::dvec3(point), 1));
}

void expectNear(glm::vec3 a, glm::vec3 b) {
    EXPECT_LT(glm::distance(a, b), 1e-5f) << a.x << " " << a.y << " " << a.z;
}

} // namespace

TEST(UsdInstances, AnInstanceScalesThenTurnsThenMovesItsPrototypeWithItsOwnTransform) {
    const LoadedScene loaded =
        loadInstancer(std::string(kChairs) +
                      "  int[] protoIndices = [0]\n  point3f[] positions = [(10, 20, 30)]\n"
                      "  quath[] orientations = [(0.70710677, 0.70710677, 0, 0)]\n"
                      "  float3[] scales = [(2, 3, 4)]\n");
    const auto meshes = meshesOf(loaded);
    ASSERT_EQ(meshes.size(), 1u);
    // (1, 1, 1): up to z = 2, scaled to (2, 3, 8), a quarter turn about x to (2, -8, 3).
    const auto tolerance = 0.02f; // orientations of half precision
    EXPECT_LT(glm::distance(at(meshes[0], {1, 1, 1}), glm::vec3(12, 12, 33)), tolerance);
    EXPECT_TRUE(loaded.diagnostics.empty());
}

TEST(UsdInstances, OrientationsOfFullPrecisionWin) {
    const LoadedScene loaded = loadInstancer(
        std::string(kChairs) + "  int[] protoIndices = [0]\n  point3f[] positions = [(0, 0, 0)]\n"
                               "  quath[] orientations = [(1, 0, 0, 0)]\n"
                               "  quatf[] orientationsf = [(0, 0, 0, 2)]\n");
    expectNear(at(meshesOf(loaded).at(0), {1, 1, 1}), {-1, -1, 2});
}

TEST(UsdInstances, EachIsAnObjectOfItsOwnAndAllShareOneMesh) {
    const LoadedScene loaded =
        loadInstancer("  rel prototypes = [</I/Prototypes/Chair>, </I/Prototypes/Ball>]\n"
                      "  int64[] protoIndices = [0, 1, 0]\n"
                      "  point3d[] positions = [(0, 0, 0), (5, 0, 0), (9, 0, 0)]\n");
    const PlacedScene placed = placeScene(*loaded.scene);
    ASSERT_EQ(placed.meshes.size(), 3u);
    EXPECT_EQ(placed.meshes[0].node, placed.meshes[2].node);
    EXPECT_NE(placed.meshes[0].node, placed.meshes[1].node);
    EXPECT_EQ(placed.meshes[2].path, "/I/instance_2/Seat");
    EXPECT_EQ(placed.meshes[1].path, "/I/instance_1/Ball");
    std::set<std::string> objects;
    for (const Object& object : placed.objects) objects.insert(object.path);
    EXPECT_EQ(objects, (std::set<std::string>{"/I/instance_0", "/I/instance_1", "/I/instance_2"}));
}

TEST(UsdInstances, HiddenAndInactiveOnesAreNotDrawn) {
    const LoadedScene loaded = loadText(
        std::string(kMetres) + "def PointInstancer \"I\" (\n inactiveIds = [12]\n)\n{\n" + kChairs +
        "  int[] protoIndices = [0, 0, 0, 0]\n  int64[] ids = [10, 11, 12, 13]\n"
        "  int64[] invisibleIds = [10]\n"
        "  point3f[] positions = [(0, 0, 0), (1, 0, 0), (2, 0, 0), (3, 0, 0)]\n" +
        kPrototypes + "}\n");
    const auto meshes = meshesOf(loaded);
    ASSERT_EQ(meshes.size(), 2u);
    EXPECT_EQ(meshes[0].path, "/I/instance_1/Seat");
    EXPECT_EQ(meshes[1].path, "/I/instance_3/Seat");
}

TEST(UsdInstances, WhatDoesNotFitIsLeftOutWithAWord) {
    const LoadedScene loaded =
        loadInstancer(std::string(kChairs) +
                      "  int[] protoIndices = [0, 3, 0, -1]\n"
                      "  point3f[] positions = [(0, 0, 0), (1, 0, 0), (inf, 0, 0), (3, 0, 0)]\n"
                      "  float3[] scales = [(1, 1, 1)]\n");
    EXPECT_EQ(meshesOf(loaded).size(), 1u);
    EXPECT_EQ(countOf(loaded, "instance of a prototype that is not there"), 2u);
    EXPECT_EQ(countOf(loaded, "not finite"), 1u);
    EXPECT_EQ(countOf(loaded, "scales of a PointInstancer ignored: 1 for 4 instances"), 1u);
    const LoadedScene nowhere =
        loadInstancer("  rel prototypes = </none>\n  int[] protoIndices = [0]\n"
                      "  point3f[] positions = [(0, 0, 0)]\n");
    EXPECT_EQ(countOf(nowhere, "prototype </none> is not there"), 1u);
    const LoadedScene bare = loadInstancer(std::string(kChairs) + "  int[] protoIndices = [0]\n");
    EXPECT_EQ(countOf(bare, "a PointInstancer without positions left out"), 1u);
}

TEST(UsdInstances, AnimatedOnesAreHeldWithAWord) {
    const LoadedScene loaded = loadInstancer(
        std::string(kChairs) + "  int[] protoIndices = [0]\n"
                               "  point3f[] positions.timeSamples = {\n   0: [(1, 0, 0)],\n"
                               "   9: [(2, 0, 0)],\n  }\n");
    expectNear(at(meshesOf(loaded).at(0), {0, 0, 0}), {1, 0, 1});
    EXPECT_EQ(countOf(loaded, "animated instances are held"), 1u);
}

TEST(UsdInstances, PrototypesElsewhereAreDrawnInPlaceToo) {
    const LoadedScene loaded = loadText(
        std::string(kMetres) +
        "def Cube \"Shown\"\n{\n}\nclass Cube \"Hidden\"\n{\n}\n"
        "def PointInstancer \"I\"\n{\n rel prototypes = [</Shown>, </Hidden>]\n"
        " int[] protoIndices = [0, 1]\n point3f[] positions = [(1, 0, 0), (2, 0, 0)]\n}\n");
    const auto meshes = meshesOf(loaded);
    ASSERT_EQ(meshes.size(), 3u);
    EXPECT_EQ(meshes[0].path, "/Shown");
    EXPECT_EQ(meshes[0].node, meshes[1].node);
    EXPECT_EQ(meshes[2].path, "/I/instance_1/Hidden");
}

TEST(UsdInstances, PrototypesInheritTheMaterialAboveThem) {
    const LoadedScene loaded = loadText(
        std::string(kMetres) +
        "def PointInstancer \"I\"\n{\n color3f[] primvars:displayColor = [(1, 0, 0)] (\n  "
        "interpolation = \"constant\"\n )\n rel prototypes = </I/Ball>\n int[] protoIndices = "
        "[0]\n point3f[] positions = [(1, 0, 0)]\n def Sphere \"Ball\"\n {\n }\n}\n");
    EXPECT_EQ(meshesOf(loaded).at(0).node->materialOf(0)->reflectance().g, 0);
}

namespace {

// Level 0 is a cube; each further level repeats the one before ten times.
std::string tower(int levels) {
    std::string text = std::string(kMetres) + "class Cube \"L0\"\n{\n}\n";
    for (int i = 1; i <= levels; ++i) {
        const std::string kind = i == levels ? "def" : "class";
        text += kind + " PointInstancer \"L" + std::to_string(i) + "\"\n{\n rel prototypes = </L" +
                std::to_string(i - 1) +
                ">\n int[] protoIndices = [0, 0, 0, 0, 0, 0, 0, 0, 0, 0]\n" +
                " point3f[] positions = [(0, 0, 0), (1, 0, 0), (2, 0, 0), (3, 0, 0), (4, 0, 0), "
                "(5, 0, 0), (6, 0, 0), (7, 0, 0), (8, 0, 0), (9, 0, 0)]\n}\n";
    }
    return text;
}

} // namespace

TEST(UsdInstances, InstancersOfInstancersMultiply) {
    const LoadedScene loaded = loadText(tower(3));
    EXPECT_EQ(meshesOf(loaded).size(), 1000u);
    EXPECT_TRUE(loaded.diagnostics.empty());
}

TEST(UsdInstances, BeyondTheBoundTheyAreLeftOutWithOneLine) {
    const LoadedScene loaded = loadText(tower(12), {.maxInstanced = 5000});
    EXPECT_LE(meshesOf(loaded).size(), 5000u);
    EXPECT_GE(meshesOf(loaded).size(), 1000u);
    ASSERT_EQ(loaded.diagnostics.size(), 1u);
    EXPECT_NE(loaded.diagnostics[0].text.find("may not make more than 5000 nodes"),
              std::string::npos);
}

TEST(UsdInstances, NoInstancerRepeatsItself) {
    const LoadedScene loaded =
        loadText(std::string(kMetres) +
                 "def Xform \"W\"\n{\n def PointInstancer \"I\"\n {\n  rel prototypes = </W>\n  "
                 "int[] protoIndices = [0]\n  point3f[] positions = [(0, 0, 0)]\n }\n}\n");
    EXPECT_TRUE(meshesOf(loaded).empty());
    EXPECT_EQ(countOf(loaded, "a PointInstancer repeats itself"), 1u);
    EXPECT_GE(countOf(loadText(tower(40)), "nested too deeply"), 1u);
}

namespace {

const std::string kLibrary =
    "class \"Lib\"\n{\n def Cube \"Box\"\n {\n }\n def Xform \"Part\"\n {\n  "
    "def Sphere \"Ball\"\n  {\n  }\n }\n}\n";

std::string chair(const std::string& name, const std::string& body,
                  const std::string& instanceable = "true") {
    return "def Xform \"" + name + "\" (\n instanceable = " + instanceable +
           "\n references = </Lib>\n)\n{\n" + body + "}\n";
}

} // namespace

TEST(UsdInstances, InstanceablePrimsOfTheSameContentsShareTheirMeshes) {
    const LoadedScene loaded =
        loadText(kMetres + kLibrary + chair("A", "") + chair("B", "") + chair("C", ""));
    const auto meshes = meshesOf(loaded);
    ASSERT_EQ(meshes.size(), 6u);
    EXPECT_EQ(meshes[0].node, meshes[2].node);
    EXPECT_EQ(meshes[1].node, meshes[5].node);
    EXPECT_EQ(meshes[5].path, "/C/Part/Ball");
}

TEST(UsdInstances, MeshesThatArePaintedDifferentlyOrNotInstanceableAreNotShared) {
    const std::string red = " color3f[] primvars:displayColor = [(1, 0, 0)] (\n  interpolation = "
                            "\"constant\"\n )\n";
    const LoadedScene loaded =
        loadText(kMetres + kLibrary + chair("A", "") + chair("B", red) + chair("C", "", "false"));
    const auto meshes = meshesOf(loaded);
    ASSERT_EQ(meshes.size(), 6u);
    EXPECT_EQ(std::set({meshes[0].node, meshes[2].node, meshes[4].node}).size(), 3u);
    EXPECT_NE(meshes[0].node->materialOf(0), meshes[2].node->materialOf(0));
}

TEST(UsdInstances, SharedMeshesHaveTheMaterialsOfTheirContents) {
    const std::string library =
        "class \"Lib\"\n{\n def Material \"M\"\n {\n  token outputs:surface.connect = "
        "</Lib/M/S.outputs:surface>\n  def Shader \"S\"\n  {\n   uniform token info:id = "
        "\"UsdPreviewSurface\"\n   color3f inputs:diffuseColor = (0.2, 0.3, 0.4)\n   token "
        "outputs:surface\n  }\n }\n def Cube \"Box\" (\n  prepend apiSchemas = "
        "[\"MaterialBindingAPI\"]\n )\n {\n  rel material:binding = </Lib/M>\n }\n}\n";
    const LoadedScene loaded = loadText(kMetres + library + chair("A", "") + chair("B", ""));
    const auto meshes = meshesOf(loaded);
    ASSERT_EQ(meshes.size(), 2u);
    EXPECT_EQ(meshes[0].node, meshes[1].node);
    EXPECT_FLOAT_EQ(meshes[1].node->materialOf(0)->reflectance().b, 0.4f);
}

} // namespace penumbra
