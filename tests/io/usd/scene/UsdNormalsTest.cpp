// Normals of the file, corner by corner.
#include "tests/io/usd/UsdTestFiles.h"

#include <gtest/gtest.h>

namespace penumbra {

namespace {

// Two triangles that share an edge, in the plane z = 0.
std::string sheet(const std::string& attributes) {
    return "def Mesh \"m\"\n{\n point3f[] points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]\n "
           "int[] faceVertexCounts = [3, 3]\n int[] faceVertexIndices = [0, 1, 2, 0, 2, 3]\n" +
           attributes + "}\n";
}
constexpr const char* kPlain = " uniform token subdivisionScheme = \"none\"\n";

std::string normals(const std::string& name, const std::string& values,
                    const std::string& interpolation) {
    return " normal3f[] " + name + " = " + values + " (\n  interpolation = \"" + interpolation +
           "\"\n )\n";
}

std::vector<glm::vec3> normalsOf(const LoadedScene& loaded) {
    return nodesByPath(*loaded.scene).at("/m").mesh()->data().normals;
}

using Normals = std::vector<glm::vec3>;
const glm::vec3 kX(1, 0, 0), kY(0, 1, 0), kZ(0, 0, 1);

} // namespace

TEST(UsdNormals, EveryInterpolationGivesOneACornerOfUnitLength) {
    const auto load = [](const std::string& values, const std::string& interpolation) {
        return normalsOf(loadText(sheet(kPlain + normals("normals", values, interpolation))));
    };
    EXPECT_EQ(load("[(0, 0, 5)]", "constant"), Normals(6, kZ));
    EXPECT_EQ(load("[(2, 0, 0), (0, 2, 0)]", "uniform"), (Normals{kX, kX, kX, kY, kY, kY}));
    const std::string points = "[(1, 0, 0), (0, 1, 0), (0, 0, 1), (0, 1, 0)]";
    EXPECT_EQ(load(points, "vertex"), (Normals{kX, kY, kZ, kX, kZ, kY}));
    EXPECT_EQ(load(points, "varying"), (Normals{kX, kY, kZ, kX, kZ, kY}));
    EXPECT_EQ(
        load("[(1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 0, 0), (0, 0, 1), (0, 1, 0)]", "faceVarying"),
        (Normals{kX, kY, kZ, kX, kZ, kY}));
}

TEST(UsdNormals, ThePrimvarWinsAndMayBeIndexed) {
    const LoadedScene loaded =
        loadText(sheet(std::string(kPlain) + normals("normals", "[(1, 0, 0)]", "constant") +
                       normals("primvars:normals", "[(0, 0, 1), (0, 1, 0)]", "uniform") +
                       " int64[] primvars:normals:indices = [1, 0]\n"));
    EXPECT_EQ(normalsOf(loaded), (Normals{kY, kY, kY, kZ, kZ, kZ}));
    EXPECT_TRUE(loaded.diagnostics.empty());
}

TEST(UsdNormals, GoWithTheirCornersWhenAMeshIsTurned) {
    const LoadedScene loaded = loadText(
        sheet(std::string(kPlain) + " uniform token orientation = \"leftHanded\"\n" +
              normals("normals", "[(1, 0, 0), (0, 1, 0), (0, 0, 1), (0, 1, 0)]", "vertex")));
    EXPECT_EQ(normalsOf(loaded), (Normals{kX, kZ, kY, kX, kY, kZ}));
}

TEST(UsdNormals, WhatDoesNotFitIsIgnoredWithOneWarning) {
    for (const char* values : {"[(0, 0, 1), (0, 0, 1)]", "[(0, 0, 1), (0, 0, 1), (0, 0, 1), "
                                                         "(0, 0, 1), (0, 0, 1)]"}) {
        const LoadedScene loaded =
            loadText(sheet(std::string(kPlain) + normals("normals", values, "vertex")));
        EXPECT_TRUE(normalsOf(loaded).empty());
        EXPECT_EQ(countOf(loaded, "normals that do not fit their mesh ignored"), 1u);
    }
    const LoadedScene indexed =
        loadText(sheet(std::string(kPlain) + normals("primvars:normals", "[(0, 0, 1)]", "uniform") +
                       " int[] primvars:normals:indices = [0, 1]\n"));
    EXPECT_EQ(countOf(indexed, "normals that do not fit their mesh ignored"), 1u);
}

TEST(UsdNormals, WhereThereAreNoneAreThoseOfASmoothSurfaceUpToACrease) {
    const auto roof = [](const char* ridge, const std::string& more) {
        return normalsOf(loadText(
            std::string("def Mesh \"m\"\n{\n point3f[] points = [(-1, 0, 0), (1, 0, 0), (1, 1, ") +
            ridge + "), (-1, 1, " + ridge +
            "), (1, 2, 0), (-1, 2, 0)]\n int[] faceVertexCounts = " +
            "[4, 4]\n int[] faceVertexIndices = [0, 1, 2, 3, 3, 2, 4, 5]\n" + kPlain + more +
            "}\n"));
    };
    EXPECT_TRUE(roof("0.5", "").empty());
    const Normals none{kX * 0.f, kX * 0.f, kZ, kZ, kZ, kZ, kX * 0.f, kX * 0.f};
    EXPECT_EQ(roof("0.125", ""), none);
    EXPECT_EQ(roof("0.125", " uniform token orientation = \"leftHanded\"\n"),
              (Normals{kX * 0.f, -kZ, -kZ, kX * 0.f, -kZ, kX * 0.f, kX * 0.f, -kZ}));
    EXPECT_EQ(roof("0.125", normals("normals", "[(1, 0, 0)]", "constant")), Normals(8, kX));
}

TEST(UsdNormals, OfSubdividedMeshesAreIgnoredAsUsdSays) {
    const LoadedScene loaded = loadText(sheet(normals("normals", "[(1, 0, 0)]", "constant")));
    EXPECT_TRUE(normalsOf(loaded).empty());
    EXPECT_TRUE(loaded.diagnostics.empty());
}

TEST(UsdNormals, NoneThatIsZeroOrNotFiniteReachesTheScene) {
    const LoadedScene loaded =
        loadText(sheet(kPlain + normals("normals", "[(inf, 0, 0), (0, 0, 0)]", "uniform")));
    EXPECT_EQ(normalsOf(loaded), Normals(6, glm::vec3(0)));
}

TEST(UsdNormals, RoundShapesHaveTheirOwn) {
    for (const char* type : {"Sphere", "Cylinder", "Cone", "Capsule"}) {
        const LoadedScene loaded = loadText("def " + std::string(type) + " \"m\"\n{\n}\n");
        const PlacedNode node = nodesByPath(*loaded.scene).at("/m");
        const MeshData& data = node.mesh()->data();
        ASSERT_EQ(data.normals.size(), data.faceVertexIndices.size()) << type;
        for (std::size_t i = 0; i < data.normals.size(); ++i) {
            const glm::vec3 corner = data.points[std::size_t(data.faceVertexIndices[i])];
            const float length = glm::length(data.normals[i]);
            EXPECT_TRUE(length == 0 || std::abs(length - 1) < 1e-5f);
            EXPECT_TRUE(length == 0 || glm::dot(data.normals[i], corner) > 0) << type;
        }
    }
    EXPECT_TRUE(normalsOf(loadText("def Cube \"m\"\n{\n}\n")).empty());
}

} // namespace penumbra
