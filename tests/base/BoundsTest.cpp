#include "base/Bounds.h"

#include "tests/scenegraph/RandomParts.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>

namespace penumbra {

namespace {

std::array<glm::vec3, 8> cornersOf(const Bounds& box) {
    std::array<glm::vec3, 8> corners;
    for (unsigned i = 0; i < 8; ++i)
        corners[i] = {i & 1 ? box.upper.x : box.lower.x, i & 2 ? box.upper.y : box.lower.y,
                      i & 4 ? box.upper.z : box.lower.z};
    return corners;
}

TEST(Bounds, AFreshBoxIsEmptyAndHoldsNothing) {
    const Bounds box;
    EXPECT_TRUE(box.empty());
    EXPECT_FALSE(box.contains({0, 0, 0}));
    EXPECT_FALSE(box.overlaps(box));
    EXPECT_EQ(box.diagonal(), 0);
}

TEST(Bounds, OnePointMakesABoxWithoutSize) {
    Bounds box;
    box.add({1, 2, 3});
    EXPECT_FALSE(box.empty());
    EXPECT_TRUE(box.contains({1, 2, 3}));
    EXPECT_EQ(box.size(), glm::vec3(0));
}

TEST(Bounds, AddingAnEmptyBoxChangesNothing) {
    Bounds box{{0, 0, 0}, {1, 1, 1}};
    box.add(Bounds());
    EXPECT_EQ(box.lower, glm::vec3(0));
    EXPECT_EQ(box.upper, glm::vec3(1));
}

TEST(Bounds, BoxesThatShareAFaceOverlap) {
    const Bounds box{{0, 0, 0}, {1, 1, 1}};
    EXPECT_TRUE(box.overlaps({{1, 0, 0}, {2, 1, 1}}));
    EXPECT_FALSE(box.overlaps({{1.001f, 0, 0}, {2, 1, 1}}));
}

TEST(Bounds, TransformedEmptyIsEmpty) {
    EXPECT_TRUE(transformed(Bounds(), glm::dmat4(2.0)).empty());
}

TEST(Bounds, AQuarterTurnSwapsTheSides) {
    const glm::dmat4 turn =
        glm::rotate(glm::dmat4(1.0), glm::radians(90.0), glm::dvec3(0, 0, 1)); // (x, y) -> (-y, x)
    const Bounds turned = transformed({{0, 0, 0}, {2, 1, 3}}, turn);
    EXPECT_NEAR(turned.lower.x, -1, 1e-6);
    EXPECT_NEAR(turned.upper.x, 0, 1e-6);
    EXPECT_NEAR(turned.upper.y, 2, 1e-6);
    EXPECT_EQ(turned.upper.z, 3);
}

// The box around the eight transformed corners, found the slow way.
RC_GTEST_PROP(Bounds, TransformedIsTheBoxAroundTheTransformedCorners, ()) {
    const Bounds before = box();
    const glm::dmat4 matrix = frame();
    const Bounds after = transformed(before, matrix);
    Bounds expected;
    for (glm::vec3 corner : cornersOf(before))
        expected.add(glm::vec3(matrix * glm::dvec4(corner, 1.0)));
    const float rounding = 1e-5f; // coordinates are below 70
    RC_ASSERT(glm::all(glm::lessThan(glm::abs(after.lower - expected.lower), glm::vec3(rounding))));
    RC_ASSERT(glm::all(glm::lessThan(glm::abs(after.upper - expected.upper), glm::vec3(rounding))));
}

} // namespace

} // namespace penumbra
