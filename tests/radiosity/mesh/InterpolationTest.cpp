// What is known at a patch's nodes, in between.
#include "radiosity/mesh/Interpolation.h"

#include <gtest/gtest.h>

#include <array>

namespace penumbra {

namespace {

Patch withCorners() {
    Patch patch;
    patch.cornerNodes = {0, 1, 2, 3};
    patch.centreNode = 4;
    patch.hasCornerNodes = true;
    return patch;
}

constexpr std::array<double, 5> kValues{1, 5, 3, 7, 20};

auto valueIn(const std::array<double, 5>& values) {
    return [&values](std::uint32_t node) { return values[node]; };
}

double at(float s, float t) {
    return interpolate<double>(withCorners(), s, t, valueIn(kValues));
}

TEST(InterpolateNodes, MeetsEveryNode) {
    EXPECT_DOUBLE_EQ(at(0, 0), 1);
    EXPECT_DOUBLE_EQ(at(1, 0), 5);
    EXPECT_DOUBLE_EQ(at(1, 1), 3);
    EXPECT_DOUBLE_EQ(at(0, 1), 7);
    EXPECT_DOUBLE_EQ(at(0.5f, 0.5f), 20);
}

TEST(InterpolateNodes, IsStraightAlongEdgesWhichNeighboursShare) {
    for (float x : {0.25f, 0.5f, 0.75f}) {
        EXPECT_DOUBLE_EQ(at(x, 0), 1 + 4.0 * x);
        EXPECT_DOUBLE_EQ(at(0, x), 1 + 6.0 * x);
        EXPECT_DOUBLE_EQ(at(1, x), 5 - 2.0 * x);
        EXPECT_DOUBLE_EQ(at(x, 1), 7 - 4.0 * x);
    }
}

TEST(InterpolateNodes, KeepsAPlane) {
    const std::array<double, 5> plane{0, 2, 5, 3, 2.5}; // 2 s + 3 t
    for (float s : {0.1f, 0.4f, 0.9f})
        for (float t : {0.2f, 0.7f})
            EXPECT_NEAR(interpolate<double>(withCorners(), s, t, valueIn(plane)), 2 * s + 3 * t,
                        1e-6);
}

TEST(InterpolateNodes, HasItsMiddleAllOverWithoutCorners) {
    Patch patch;
    patch.centreNode = 2;
    EXPECT_DOUBLE_EQ(interpolate<double>(patch, 0.1f, 0.9f, valueIn(kValues)), 3);
}

} // namespace

} // namespace penumbra
