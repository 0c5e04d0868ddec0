#include "scenegraph/Light.h"

#include <gtest/gtest.h>

namespace penumbra {

namespace {

void expectHalfSize(const LightShape& shape, glm::vec3 half) {
    const Bounds bounds = Light("lamp", shape, Rgb(1)).bounds();
    EXPECT_EQ(bounds.lower, -half);
    EXPECT_EQ(bounds.upper, half);
}

TEST(Light, BoundsFollowTheShape) {
    expectHalfSize(RectShape{2, 1}, {1, 0.5f, 0});
    expectHalfSize(DiskShape{0.25f}, {0.25f, 0.25f, 0});
    expectHalfSize(SphereShape{0.1f}, {0.1f, 0.1f, 0.1f});
}

} // namespace

} // namespace penumbra
