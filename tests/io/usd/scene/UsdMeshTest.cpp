#include "tests/io/usd/UsdTestFiles.h"

#include <gtest/gtest.h>

#include <limits>

namespace penumbra {

namespace {

std::string array(const std::vector<int>& values) {
    std::string text = "[";
    for (const int v : values) text += (text.size() > 1 ? ", " : "") + std::to_string(v);
    return text + "]";
}

// A mesh </m> over the corners of a 2 x 1 grid of squares:  3 4 5
//                                                           0 1 2
LoadedScene grid(const std::vector<int>& counts, const std::vector<int>& indices,
                 const std::string& more = "", const std::string& scheme = "none") {
    return loadText("(metersPerUnit = 1)\ndef Mesh \"m\"\n{\n int[] faceVertexCounts = " +
                    array(counts) + "\n int[] faceVertexIndices = " + array(indices) +
                    "\n point3f[] points = [(0, 0, 0), (1, 0, 0), (2, 0, 0), (0, 1, 0), (1, 1, 0), "
                    "(2, 1, 0), (inf, 0, 0)]\n"
                    " uniform token subdivisionScheme = \"" +
                    scheme + "\"\n" + more + "\n}\n");
}

const std::vector<int> kCounts{4, 4};
const std::vector<int> kIndices{0, 1, 4, 3, 1, 2, 5, 4};

const MeshData* dataOf(const LoadedScene& loaded) {
    const auto nodes = nodesByPath(*loaded.scene);
    const PlacedNode* placed = leafOf(nodes, "/m");
    return placed && placed->mesh() ? &placed->mesh()->data() : nullptr;
}

std::vector<Rgb> faceColours(const MeshData& data) {
    std::vector<Rgb> colours;
    for (std::size_t f = 0; f < data.faceVertexCounts.size(); ++f)
        colours.push_back(
            data.materials[data.faceMaterial.empty() ? 0 : data.faceMaterial[f]]->reflectance());
    return colours;
}

} // namespace

TEST(UsdMesh, FacesKeepTheirWinding) {
    const LoadedScene right = grid(kCounts, kIndices);
    EXPECT_EQ(dataOf(right)->faceVertexIndices,
              (std::vector<std::int32_t>{0, 1, 4, 3, 1, 2, 5, 4}));
    const LoadedScene left = grid(kCounts, kIndices, "uniform token orientation = \"leftHanded\"");
    EXPECT_EQ(dataOf(left)->faceVertexIndices, (std::vector<std::int32_t>{0, 3, 4, 1, 1, 4, 5, 2}));
}

TEST(UsdMesh, UnusableFacesAreLeftOutAndCounted) {
    const struct {
        std::vector<int> counts, indices;
        const char* text;
        std::size_t count;
    } cases[] = {{{4, 2}, {0, 1, 4, 3, 1, 2}, "fewer than 3", 1},
                 {{4, -1, 0}, {0, 1, 4, 3}, "fewer than 3", 2},
                 {{4, 3}, {0, 1, 4, 3, 1, 2, 99}, "out of range", 1},
                 {{4, 3}, {0, 1, 4, 3, 1, 2, -1}, "out of range", 1},
                 {{4, 3}, {0, 1, 4, 3, 0, 1, 6}, "not finite", 1},
                 {{4, 3}, {0, 1, 4, 3, 0, 1, 2}, "without area", 1},
                 {{4, 4, 4}, {0, 1, 4, 3, 1, 2}, "beyond the end", 2},
                 {{4, std::numeric_limits<int>::max(), std::numeric_limits<int>::max()},
                  {0, 1, 4, 3, 1, 2},
                  "beyond the end",
                  2},
                 {{4}, {0, 1, 4, 3, 1, 2}, "belong to no face", 1}};
    for (const auto& c : cases) {
        const LoadedScene loaded = grid(c.counts, c.indices);
        EXPECT_EQ(countOf(loaded, c.text), c.count) << c.text;
        ASSERT_TRUE(dataOf(loaded)) << c.text;
        EXPECT_EQ(dataOf(loaded)->faceVertexIndices, (std::vector<std::int32_t>{0, 1, 4, 3}))
            << c.text;
        EXPECT_EQ(dataOf(loaded)->points.at(6),
                  glm::vec3(0)); // nothing that isn't finite gets through
    }
    EXPECT_FALSE(dataOf(grid({}, {})));
    EXPECT_EQ(countOf(grid({}, {}), "without visible faces"), 1u);
}

TEST(UsdMesh, EnormousFacesAreLeftOut) {
    std::vector<int> indices(100'001);
    for (std::size_t i = 0; i < indices.size(); ++i) indices[i] = int(i % 6);
    EXPECT_EQ(countOf(grid({100'001}, indices), "more than 100000 corners"), 1u);
}

TEST(UsdMesh, SubdivisionTagsComeAlong) {
    const LoadedScene loaded = grid(kCounts, kIndices,
                                    "int[] creaseIndices = [0, 1, 2, 3, 4]\nint[] creaseLengths = "
                                    "[3, 2]\nfloat[] creaseSharpnesses = [2, 20]\n"
                                    "int[] cornerIndices = [5, 77]\nfloat[] cornerSharpnesses = "
                                    "[10, 10]\nint[] holeIndices = [1]\n"
                                    "bool doubleSided = 1",
                                    "catmullClark");
    const MeshData& data = *dataOf(loaded);
    EXPECT_EQ(data.scheme, SubdivisionScheme::catmullClark);
    ASSERT_EQ(data.creases.size(), 2u);
    EXPECT_EQ(data.creases[0].vertices, (std::vector<std::int32_t>{0, 1, 2}));
    EXPECT_EQ(data.creases[1].sharpness, 10); // the scale ends there
    ASSERT_EQ(data.corners.size(), 1u);
    EXPECT_EQ(data.corners[0].vertex, 5);
    EXPECT_EQ(data.holes, std::vector<std::int32_t>{1});
    EXPECT_TRUE(data.doubleSided);
    EXPECT_EQ(countOf(loaded, "unusable corners"), 1u);
}

TEST(UsdMesh, SharpnessMayBeGivenForEachEdge) {
    const LoadedScene loaded = grid(kCounts, kIndices,
                                    "int[] creaseIndices = [0, 1, 2]\nint[] creaseLengths = "
                                    "[3]\nfloat[] creaseSharpnesses = [1, 2]",
                                    "bilinear");
    ASSERT_EQ(dataOf(loaded)->creases.size(), 2u);
    EXPECT_EQ(dataOf(loaded)->creases[1].vertices, (std::vector<std::int32_t>{1, 2}));
    EXPECT_EQ(dataOf(loaded)->creases[1].sharpness, 2);
}

TEST(UsdMesh, BrokenCreasesAreDropped) {
    for (const char* tags : {"int[] creaseIndices = [0, 1]\nint[] creaseLengths = [3]\nfloat[] "
                             "creaseSharpnesses = [1]",
                             "int[] creaseIndices = [0, 99]\nint[] creaseLengths = [2]\nfloat[] "
                             "creaseSharpnesses = [1]",
                             "int[] creaseIndices = [0, 1]\nint[] creaseLengths = [-2]\nfloat[] "
                             "creaseSharpnesses = [1]",
                             "int[] creaseIndices = [0, 1]\nint[] creaseLengths = [2]"}) {
        const LoadedScene loaded = grid(kCounts, kIndices, tags, "catmullClark");
        EXPECT_TRUE(dataOf(loaded)->creases.empty()) << tags;
        EXPECT_EQ(countOf(loaded, "unusable creases"), 1u) << tags;
    }
}

TEST(UsdMesh, WithoutSubdivisionAHoleIsNotThere) {
    const LoadedScene loaded = grid(kCounts, kIndices, "int[] holeIndices = [0, 44, -1]");
    EXPECT_EQ(dataOf(loaded)->faceVertexIndices, (std::vector<std::int32_t>{1, 2, 5, 4}));
}

TEST(UsdMesh, CatmullClarkIsTheDefaultAndLoopNeedsTriangles) {
    EXPECT_EQ(dataOf(loadText("def Mesh \"m\"\n{\n int[] faceVertexCounts = [3]\n int[] "
                              "faceVertexIndices = [0, 1, 2]\n"
                              " point3f[] points = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]\n}\n"))
                  ->scheme,
              SubdivisionScheme::catmullClark);
    EXPECT_EQ(dataOf(grid({3}, {0, 1, 4}, "", "loop"))->scheme, SubdivisionScheme::loop);
    EXPECT_EQ(dataOf(grid(kCounts, kIndices, "", "loop"))->scheme, SubdivisionScheme::none);
    EXPECT_EQ(dataOf(grid(kCounts, kIndices, "", "strange"))->scheme, SubdivisionScheme::none);
}

TEST(UsdMesh, DisplayColourMayBeConstantOrVary) {
    const auto colours = [](const std::string& values, const std::string& interpolation) {
        return faceColours(*dataOf(grid(kCounts, kIndices,
                                        "color3f[] primvars:displayColor = " + values +
                                            " (interpolation = \"" + interpolation + "\")")));
    };
    const std::vector<Rgb> wanted{Rgb(0.2f), Rgb(0.6f)};
    EXPECT_EQ(colours("[(0.2, 0.2, 0.2)]", "constant"), (std::vector<Rgb>{Rgb(0.2f), Rgb(0.2f)}));
    EXPECT_EQ(colours("[(0.2, 0.2, 0.2), (0.6, 0.6, 0.6)]", "uniform"), wanted);
    const auto vertex = colours(
        "[(0, 0, 0), (0.4, 0, 0), (0.8, 0, 0), (0, 0, 0), (0.4, 0, 0), (0.8, 0, 0), (0, 0, 0)]",
        "vertex");
    EXPECT_FLOAT_EQ(vertex[0].r, 0.2f); // the mean of the corners
    EXPECT_FLOAT_EQ(vertex[1].r, 0.6f);
    const auto corners = colours("[(0, 0, 0), (0.4, 0, 0), (0.4, 0, 0), (0, 0, 0), (0.4, 0, 0), "
                                 "(0.8, 0, 0), (0.8, 0, 0), (0.4, 0, 0)]",
                                 "faceVarying");
    EXPECT_FLOAT_EQ(corners[0].r, 0.2f);
    EXPECT_FLOAT_EQ(corners[1].r, 0.6f);
    const LoadedScene tooShort = grid(kCounts, kIndices,
                                      "color3f[] primvars:displayColor = [(0.1, 0.1, 0.1), (1, 1, "
                                      "1)] (interpolation = \"vertex\")");
    EXPECT_EQ(faceColours(*dataOf(tooShort)).at(0), Rgb(0.1f));
    EXPECT_EQ(countOf(tooShort, "too short"), 1u);
}

TEST(UsdMesh, DisplayColourMayBeIndexedAndInherited) {
    const LoadedScene indexed = grid(kCounts, kIndices,
                                     "color3f[] primvars:displayColor = [(0.2, 0.2, 0.2), (0.6, "
                                     "0.6, 0.6)] (interpolation = \"uniform\")\n"
                                     "int[] primvars:displayColor:indices = [1, 0]");
    EXPECT_EQ(faceColours(*dataOf(indexed)), (std::vector<Rgb>{Rgb(0.6f), Rgb(0.2f)}));
    const LoadedScene below = loadText("def Xform \"x\"\n{\n color3f[] primvars:displayColor = "
                                       "[(0.2, 0.2, 0.2)]\n def Cube \"c\"\n {\n }\n}\n");
    EXPECT_EQ(nodesByPath(*below.scene).at("/x/c").mesh()->data().materials.at(0)->reflectance(),
              Rgb(0.2f));
}

TEST(UsdMesh, SubsetsHaveMaterialsOfTheirOwn) {
    const std::string subset = "def GeomSubset \"s\"\n{\n uniform token elementType = \"face\"\n "
                               "int[] indices = [1, 9]\n rel material:binding = </M>\n}\n";
    const LoadedScene loaded =
        loadText("def Mesh \"m\"\n{\n int[] faceVertexCounts = [3, 4, 4]\n int[] faceVertexIndices "
                 "= [0, 0, 0, 0, 1, 4, 3, 1, 2, 5, 4]\n"
                 " point3f[] points = [(0, 0, 0), (1, 0, 0), (2, 0, 0), (0, 1, 0), (1, 1, 0), (2, "
                 "1, 0)]\n uniform token subdivisionScheme = \"none\"\n" +
                 subset +
                 "}\ndef Material \"M\"\n{\n token outputs:surface.connect = "
                 "</M/S.outputs:surface>\n def Shader \"S\"\n {\n"
                 " uniform token info:id = \"UsdPreviewSurface\"\n color3f inputs:diffuseColor = "
                 "(0.1, 0.1, 0.1)\n }\n}\n");
    // The file's face 0 has no area; its face 1 is the first that is left.
    EXPECT_EQ(faceColours(*dataOf(loaded)), (std::vector<Rgb>{Rgb(0.1f), Rgb(0.5f)}));
    EXPECT_EQ(countOf(loaded, "faces that are not there"), 1u);
}

} // namespace penumbra
