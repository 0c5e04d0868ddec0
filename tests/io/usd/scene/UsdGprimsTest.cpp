#include "tests/io/usd/UsdTestFiles.h"

#include <gtest/gtest.h>

#include <map>
#include <numbers>

namespace penumbra {

namespace {

constexpr double kPi = std::numbers::pi;

const MeshData* gprim(LoadedScene& loaded, const std::string& type, const std::string& body = "") {
    loaded = loadText("(metersPerUnit = 1)\ndef " + type + " \"g\"\n{\n" + body + "\n}\n");
    const auto nodes = nodesByPath(*loaded.scene);
    const PlacedNode* placed = leafOf(nodes, "/g");
    return placed && placed->mesh() ? &placed->mesh()->data() : nullptr;
}

// A closed surface, every face seen from outside: each edge is used once in each direction, and the
// enclosed volume (divergence theorem) is positive.
double volumeOfClosed(const MeshData& data) {
    std::map<std::pair<int, int>, int> edges;
    double volume = 0;
    std::size_t offset = 0;
    for (const int count : data.faceVertexCounts) {
        const auto corner = [&](int i) {
            return data.faceVertexIndices[offset + std::size_t(i % count)];
        };
        const auto point = [&](int i) { return glm::dvec3(data.points[std::size_t(corner(i))]); };
        for (int i = 0; i < count; ++i) ++edges[{corner(i), corner(i + 1)}];
        for (int i = 1; i + 1 < count; ++i)
            volume += glm::dot(point(0), glm::cross(point(i), point(i + 1))) / 6;
        offset += std::size_t(count);
    }
    for (const auto& [edge, uses] : edges) {
        EXPECT_EQ(uses, 1);
        EXPECT_EQ((edges.count({edge.second, edge.first})), 1u);
    }
    return volume;
}

} // namespace

TEST(UsdGprims, SolidsAreClosedAndNearlyAsLargeAsTheTrueOnes) {
    // Vertices lie on the true surface, so what is round is a little smaller: 32 sides hold 0.6 %
    // less.
    const struct {
        const char* type;
        std::size_t faces;
        double volume;
    } cases[] = {{"Cube", 6, 8},
                 {"Sphere", 512, 4 * kPi / 3},
                 {"Cylinder", 34, 2 * kPi},
                 {"Cone", 33, 2 * kPi / 3},
                 {"Capsule", 544, kPi / 4 + kPi / 6}};
    for (const auto& c : cases)
        for (const char* axis : {"X", "Y", "Z"}) {
            SCOPED_TRACE(std::string(c.type) + axis);
            LoadedScene loaded;
            const MeshData* data =
                gprim(loaded, c.type, std::string("uniform token axis = \"") + axis + "\"");
            ASSERT_TRUE(data);
            EXPECT_EQ(data->faceVertexCounts.size(), c.faces);
            EXPECT_NEAR(volumeOfClosed(*data), c.volume, 0.025 * c.volume);
            EXPECT_FALSE(data->doubleSided);
        }
}

TEST(UsdGprims, TheAxisIsWhereTheFileSays) {
    LoadedScene loaded;
    const MeshData* cone = gprim(loaded, "Cone", "uniform token axis = \"X\"\ndouble height = 6");
    Bounds box;
    for (const glm::vec3 p : cone->points) box.add(p);
    EXPECT_FLOAT_EQ(box.upper.x, 3);
    EXPECT_FLOAT_EQ(box.upper.y, 1);
    // The apex is at +axis: nothing else is there.
    EXPECT_EQ(std::count_if(cone->points.begin(), cone->points.end(),
                            [](glm::vec3 p) { return p.x > 2.9f; }),
              1);
}

TEST(UsdGprims, APlaneFacesItsAxis) {
    for (const int axis : {0, 1, 2}) {
        LoadedScene loaded;
        const MeshData* plane = gprim(loaded, "Plane",
                                      std::string("uniform token axis = \"") + char('X' + axis) +
                                          "\"\ndouble width = 4\ndouble length = 6");
        ASSERT_TRUE(plane);
        EXPECT_TRUE(plane->doubleSided);
        const auto& p = plane->points;
        const glm::vec3 normal = glm::normalize(glm::cross(p[1] - p[0], p[2] - p[0]));
        EXPECT_FLOAT_EQ(normal[axis], 1);
        // axis X: width along Z, length along Y; Y: width X, length Z; Z: width X, length Y.
        const int width = axis == 0 ? 2 : 0;
        const int length = axis == 1 ? 2 : 1;
        EXPECT_FLOAT_EQ(std::abs(p[0][width]), 2);
        EXPECT_FLOAT_EQ(std::abs(p[0][length]), 3);
    }
}

TEST(UsdGprims, NothingComesOfNoSize) {
    for (const char* body : {"double radius = 0", "double radius = -1", "double radius = nan",
                             "double radius = inf"}) {
        LoadedScene loaded;
        EXPECT_FALSE(gprim(loaded, "Sphere", body)) << body;
        EXPECT_EQ(countOf(loaded, "without size"), 1u) << body;
    }
}

// A hundred thousand marbles would take 5 GB.
TEST(UsdGprims, ThoseOfOneSizeAndMaterialAreOneMesh) {
    const std::string translated =
        "double3 xformOp:translate = (1, 0, 0)\nuniform token[] xformOpOrder = "
        "[\"xformOp:translate\"]\n";
    const LoadedScene loaded =
        loadText("def Sphere \"a\"\n{\n double radius = 2\n" + translated + "}\n" +
                 "def Sphere \"b\"\n{\n double radius = 2\n token visibility = \"inherited\"\n" +
                 translated + "}\n" + "def Sphere \"larger\"\n{\n double radius = 3\n" +
                 translated + "}\n" + "def Sphere \"red\"\n{\n double radius = 2\n" + translated +
                 " color3f[] primvars:displayColor = [(1, 0, 0)]\n}\n" +
                 "def Sphere \"bound\" (prepend apiSchemas = [\"MaterialBindingAPI\"])\n{\n"
                 " double radius = 2\n" +
                 translated + " rel material:binding = </M>\n}\n" +
                 "def Material \"M\"\n{\n token outputs:surface.connect = </M/S.outputs:surface>\n"
                 " def Shader \"S\"\n {\n  uniform token info:id = \"UsdPreviewSurface\"\n"
                 "  color3f inputs:diffuseColor = (0, 0, 0.5)\n  token outputs:surface\n }\n}\n");
    const auto nodes = nodesByPath(*loaded.scene);
    const auto mesh = [&](const char* path) { return leafOf(nodes, path)->mesh(); };
    ASSERT_TRUE(mesh("/a"));
    EXPECT_EQ(mesh("/a"), mesh("/b"));
    for (const char* other : {"/larger", "/red", "/bound"}) EXPECT_NE(mesh("/a"), mesh(other));
    EXPECT_FLOAT_EQ(mesh("/bound")->materialOf(0)->reflectance().b, 0.5f);
}

} // namespace penumbra
