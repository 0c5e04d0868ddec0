// Which triangles are taken for the halves of a quadrilateral.
#include "radiosity/surface/TrianglePairs.h"
#include "tests/support/Scenes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <vector>

namespace penumbra {

namespace {

using Place = std::array<float, 3>;
using Triangle = std::array<std::int32_t, 3>;

MeshData trianglesData(std::vector<glm::vec3> points, const std::vector<Triangle>& triangles) {
    MeshData data;
    data.points = std::move(points);
    for (const Triangle& t : triangles) {
        data.faceVertexCounts.push_back(3);
        data.faceVertexIndices.insert(data.faceVertexIndices.end(), t.begin(), t.end());
    }
    data.materials = {paint(Rgb(0.5f))};
    return data;
}

MeshData rectangle() {
    return trianglesData({{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}});
}

/// Corners of all faces, each face from its least corner on, in order.
std::vector<std::vector<Place>> facesOf(const MeshData& data) {
    const SurfaceMesh mesh = placeSurface(data, glm::dmat4(1.0));
    std::vector<std::vector<Place>> faces;
    for (const SurfaceFace& face : mesh.faces) {
        auto& corners = faces.emplace_back();
        for (const std::uint32_t corner : mesh.cornersOf(face)) {
            const glm::vec3 p = mesh.points[corner];
            corners.push_back({p.x, p.y, p.z});
        }
        std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()),
                    corners.end());
    }
    std::sort(faces.begin(), faces.end());
    return faces;
}

TEST(JoinTriangles, MakesARectangleOfItsHalves) {
    EXPECT_THAT(facesOf(rectangle()), testing::ElementsAre(std::vector<Place>{
                                          {0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {0, 1, 0}}));
}

TEST(JoinTriangles, TurnsTheSameWayAsTheyDid) {
    MeshData turned = rectangle();
    turned.faceVertexIndices = {2, 1, 0, 3, 2, 0};
    EXPECT_THAT(facesOf(turned), testing::ElementsAre(std::vector<Place>{
                                     {0, 0, 0}, {0, 1, 0}, {3, 1, 0}, {3, 0, 0}}));
}

TEST(JoinTriangles, LeavesThoseAloneThatAreNoHalves) {
    MeshData bent = rectangle();
    bent.points[3].z = 0.01f;
    EXPECT_EQ(facesOf(bent).size(), 2u);
    MeshData painted = rectangle();
    painted.materials.push_back(paint(Rgb(0.2f)));
    painted.faceMaterial = {0, 1};
    EXPECT_EQ(facesOf(painted).size(), 2u);
    MeshData twisted = rectangle(); // one shows its back
    twisted.faceVertexIndices = {0, 1, 2, 3, 2, 0};
    EXPECT_EQ(facesOf(twisted).size(), 2u);
    // The edge in common is not the longest of both.
    EXPECT_EQ(facesOf(trianglesData({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-3, 1, 0}},
                                    {{0, 1, 2}, {0, 2, 3}}))
                  .size(),
              2u);
}

TEST(JoinTriangles, LeavesFansOfSliversAlone) {
    EXPECT_EQ(facesOf(trianglesData({{0, 0, 0}, {5, 0, 0}, {5, 0.3f, 0}, {4.98f, 0.6f, 0}},
                                    {{0, 1, 2}, {0, 2, 3}}))
                  .size(),
              2u);
}

TEST(JoinTriangles, LeavesTexturesAsTheyLie) {
    MeshData textured = rectangle();
    textured.uvs = {{0, 0}, {3, 0}, {3, 1}, {0, 0}, {3, 1}, {0, 1}};
    EXPECT_EQ(facesOf(textured).size(), 1u);
    textured.uvs[5] = {0.3f, 1}; // bent along the edge
    EXPECT_EQ(facesOf(textured).size(), 2u);
    textured.uvs = {{0, 0}, {3, 0}, {3, 1}, {0, 2}, {3, 3}, {0, 3}}; // cut along it
    EXPECT_EQ(facesOf(textured).size(), 2u);
}

TEST(JoinTriangles, IsAMatterOfTheTrianglesNotOfTheirOrder) {
    // A grid of squares, in which each half has the same longest edge twice.
    std::vector<glm::vec3> points;
    for (int y = 0; y < 6; ++y)
        for (int x = 0; x < 6; ++x) points.emplace_back(float(x), float(y), 0.0f);
    std::vector<Triangle> triangles;
    std::mt19937 random(7);
    for (int i = 0; i < 30; ++i) {
        if (i % 6 == 5) continue;
        const bool other = random() % 2;
        triangles.push_back(other ? Triangle{i, i + 1, i + 6} : Triangle{i, i + 1, i + 7});
        triangles.push_back(other ? Triangle{i + 1, i + 7, i + 6} : Triangle{i, i + 7, i + 6});
    }
    const auto faces = facesOf(trianglesData(points, triangles));
    EXPECT_EQ(faces.size(), 25u);
    for (int i = 0; i < 10; ++i) {
        std::shuffle(triangles.begin(), triangles.end(), random);
        for (Triangle& t : triangles) std::rotate(t.begin(), t.begin() + random() % 3, t.end());
        EXPECT_EQ(facesOf(trianglesData(points, triangles)), faces);
    }
}

} // namespace

} // namespace penumbra
