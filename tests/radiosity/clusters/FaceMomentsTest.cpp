// Integrals over faces, against those that can be written down.
#include "radiosity/clusters/FaceMoments.h"
#include "radiosity/clusters/Slabs.h"
#include "tests/radiosity/clusters/ClusterMeshes.h"

#include <gtest/gtest.h>

namespace penumbra {

namespace {

TEST(FaceMoments, OfASquareAreThoseOfCalculus) {
    // Edge 2 around (1, 2, 3), upright to z: the variance along its edge is 2^2/12.
    const std::vector<glm::vec3> points{{0, 1, 3}, {2, 1, 3}, {2, 3, 3}, {0, 3, 3}};
    const FaceMoments moments = momentsOf(points, std::vector<std::uint32_t>{0, 1, 2, 3});
    EXPECT_DOUBLE_EQ(moments.area, 4);
    EXPECT_EQ(moments.normal(), glm::dvec3(0, 0, 1));
    EXPECT_LT(glm::distance(moments.centroid(), glm::dvec3(1, 2, 3)), 1e-12);
    EXPECT_NEAR(moments.variance({1, 0, 0}), 4.0 / 12, 1e-12);
    EXPECT_NEAR(moments.variance({0, 1, 0}), 4.0 / 12, 1e-12);
    EXPECT_NEAR(moments.variance({0, 0, 1}), 0, 1e-12);
}

TEST(FaceMoments, OfABallAreThoseOfCalculus) {
    // Radius 1: area 4 pi, vector area 0, variance 1/3 along any direction.
    const ClusterMesh mesh = bumpyBall(1, 100, {1, 2, 3}, 0);
    FaceMoments moments;
    for (std::size_t face = 0; face < mesh.size(); ++face)
        moments.add(momentsOf(mesh.points, mesh.soup().cornersOf(face)));
    EXPECT_NEAR(moments.area, 4 * std::numbers::pi, 0.01);
    EXPECT_LT(glm::length(moments.vectorArea), 1e-5);
    EXPECT_LT(glm::distance(moments.centroid(), glm::dvec3(1, 2, 3)), 1e-5);
    EXPECT_NEAR(moments.variance(glm::normalize(glm::dvec3(1, 2, -2))), 1.0 / 3, 1e-3);
}

TEST(Slabs, HaveAnExtentOfAtLeast88PercentOfAnyDistance) {
    std::mt19937 random(1);
    std::normal_distribution<float> normal;
    float least = 1;
    for (int i = 0; i < 20000; ++i) {
        const glm::vec3 p =
            glm::normalize(glm::vec3(normal(random), normal(random), normal(random)));
        Slabs slabs;
        slabs.add({0, 0, 0});
        slabs.add(p);
        EXPECT_LE(slabs.extent(), 1 + 1e-6f);
        least = std::min(least, slabs.extent());
    }
    EXPECT_GT(least, 0.88f);
    EXPECT_LT(least, 0.90f); // the comment is not too careful
}

} // namespace

} // namespace penumbra
