// Smooth surfaces that polygons stand for, and the creases between them.
#include "scenegraph/CreaseNormals.h"

#include "SceneParts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace penumbra {

namespace {

// An open tube of `sides` quads around z, radius 1, from z = 0 to 1; each quad has points of its
// own.
MeshData tube(int sides) {
    MeshData data;
    for (int i = 0; i < sides; ++i) {
        for (const auto& [k, z] : {std::pair(i, 0.0f), {i + 1, 0.0f}, {i + 1, 1.0f}, {i, 1.0f}}) {
            const double turn = 2 * std::numbers::pi * double(k % sides) / sides;
            data.faceVertexIndices.push_back(std::int32_t(data.points.size()));
            data.points.emplace_back(std::cos(turn), std::sin(turn), z);
        }
        data.faceVertexCounts.push_back(4);
    }
    return data;
}

// Two walls 1 high that meet along the y axis: one to x = -length, one to x = 1, turned by
// `degrees`.
MeshData bay(float length, double degrees) {
    const double turn = degrees * std::numbers::pi / 180;
    const float x = float(std::cos(turn)), z = float(std::sin(turn));
    MeshData data;
    data.points = {{-length, 0, 0}, {0, 0, 0}, {0, 1, 0}, {-length, 1, 0}, {x, 0, z}, {x, 1, z}};
    data.faceVertexCounts = {4, 4};
    data.faceVertexIndices = {0, 1, 2, 3, 1, 4, 5, 2};
    return data;
}

float turnOf(glm::vec3 normal) {
    return float(std::atan2(-normal.x, normal.z) * 180 / std::numbers::pi);
}

} // namespace

TEST(CreaseNormals, OfATubePointAwayFromItsAxis) {
    const MeshData data = tube(16);
    const auto normals = creaseNormals(data);
    ASSERT_EQ(normals.size(), data.faceVertexIndices.size());
    for (std::size_t c = 0; c < normals.size(); ++c) {
        const glm::vec3 p = data.points[std::size_t(data.faceVertexIndices[c])];
        EXPECT_LT(glm::length(normals[c] - glm::vec3(p.x, p.y, 0)), 1e-5f);
    }
}

TEST(CreaseNormals, AreNotThereWhereFacesMeetAtMoreThanTheAngle) {
    EXPECT_TRUE(creaseNormals(tube(11)).empty());
    EXPECT_FALSE(creaseNormals(tube(13)).empty());
    EXPECT_TRUE(creaseNormals(bay(1, kCreaseAngle + 0.1)).empty());
    EXPECT_FALSE(creaseNormals(bay(1, kCreaseAngle - 0.1)).empty());
    EXPECT_TRUE(creaseNormals(bay(1, 0)).empty()) << "one plane";
}

TEST(CreaseNormals, StandOnlyAtTheCornersThatTheBendReaches) {
    const auto normals = creaseNormals(bay(1, 20));
    ASSERT_EQ(normals.size(), 8u);
    for (const std::size_t far : {0, 3, 5, 6}) EXPECT_EQ(normals[far], glm::vec3(0));
    for (const std::size_t near : {1, 2, 4, 7}) EXPECT_NEAR(turnOf(normals[near]), 10, 0.01);
}

TEST(CreaseNormals, LeaveALargeWallFlatBesideANarrowBevel) {
    EXPECT_LT(turnOf(creaseNormals(bay(100, 20))[1]), 0.3);
}

TEST(CreaseNormals, DoNotJoinTheTwoSidesOfASheet) {
    MeshData data = square("sheet")->data();
    const auto face = data.faceVertexIndices;
    data.faceVertexIndices.insert(data.faceVertexIndices.end(), face.rbegin(), face.rend());
    data.faceVertexCounts.push_back(4);
    EXPECT_TRUE(creaseNormals(data).empty());
}

TEST(CreaseNormals, AFanOfAHundredThousandFacesTakesNoTimeAndStaysFlatAtItsTip) {
    MeshData data;
    const int sides = 100'000;
    data.points.emplace_back(0, 0, 0.1f);
    for (int i = 0; i < sides; ++i) {
        const double turn = 2 * std::numbers::pi * i / sides;
        data.points.emplace_back(std::cos(turn), std::sin(turn), 0);
        data.faceVertexCounts.push_back(3);
        data.faceVertexIndices.insert(data.faceVertexIndices.end(),
                                      {0, i + 1, (i + 1) % sides + 1});
    }
    EXPECT_TRUE(creaseNormals(data).empty() || creaseNormals(data)[0] == glm::vec3(0));
}

} // namespace penumbra
