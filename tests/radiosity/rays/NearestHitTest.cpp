// What is met first, of what is offered.
#include "radiosity/rays/NearestHit.h"

#include <gtest/gtest.h>

#include <array>

namespace penumbra {

namespace {

using Corners = std::array<glm::vec3, 3>;
// Two halves of a square around the origin, front up; and one that lies on it.
constexpr Corners kLower{{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}}};
constexpr Corners kUpper{{{-1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}};

RayHit offered(std::uint32_t object, std::uint32_t triangle, float distance) {
    RayHit hit;
    hit.object = {object};
    hit.triangle = triangle;
    hit.distance = distance;
    return hit;
}

TEST(NearestHit, OnASharedEdgeIsTheFirstTriangleInEitherOrder) {
    for (bool swapped : {false, true}) {
        NearestHit nearest({0.25f, 0.25f, 2}, {0, 0, -1});
        const std::array order{swapped ? 1u : 0u, swapped ? 0u : 1u};
        for (std::uint32_t t : order)
            nearest.take(t == 0 ? kLower : kUpper, offered(0, t, 2), kFront);
        EXPECT_EQ(nearest.hit().triangle, 0u);
        EXPECT_FLOAT_EQ(nearest.hit().distance, 2);
    }
}

TEST(NearestHit, TellsWhereOnTheTriangle) {
    NearestHit nearest({0.5f, -0.25f, 1}, {0, 0, -2});
    ASSERT_TRUE(nearest.take(kLower, offered(3, 7, 0.5f), kFront));
    const RayHit& hit = nearest.hit();
    const glm::vec3 at = (1 - hit.u - hit.v) * kLower[0] + hit.u * kLower[1] + hit.v * kLower[2];
    EXPECT_FLOAT_EQ(at.x, 0.5f);
    EXPECT_FLOAT_EQ(at.y, -0.25f);
    EXPECT_FLOAT_EQ(hit.distance, 0.5f);
    EXPECT_EQ(hit.object.value, 3u);
}

TEST(NearestHit, MeetsBacksOnlyIfAsked) {
    NearestHit nearest({0.5f, -0.25f, -1}, {0, 0, 1});
    EXPECT_FALSE(nearest.take(kLower, offered(0, 0, 1), kFront));
    EXPECT_FALSE(nearest.take(kLower, offered(0, 0, 1), kNoSide));
    EXPECT_FALSE(nearest.inDoubt()); // a back is not passed by: it is not there
    EXPECT_TRUE(nearest.take(kLower, offered(0, 0, 1), kBack));
    EXPECT_TRUE(nearest.hit().back);
}

TEST(NearestHit, IsInDoubtAboutWhatItPassesByUnlessTheNeighbourIsMet) {
    // Beside the lower half by less than what floats tell apart.
    const glm::vec3 from(0.25f, 0.25f + 3e-8f, 2);
    NearestHit nearest(from, {0, 0, -1});
    EXPECT_FALSE(nearest.take(kLower, offered(0, 0, 2), kFront));
    ASSERT_TRUE(nearest.inDoubt());
    const glm::vec3 aside = nearest.aside(1e-4f);
    EXPECT_NEAR(glm::length(aside), 1e-4, 1e-9);
    EXPECT_EQ(aside.z, 0);           // beside the ray
    EXPECT_GT(aside.y - aside.x, 0); // away from the lower half
    EXPECT_TRUE(nearest.take(kUpper, offered(0, 1, 2), kFront));
    EXPECT_FALSE(nearest.inDoubt());
}

TEST(NearestHit, TellsWhichSideItPassesBy) {
    const glm::vec3 beside(0.25f, 0.25f + 3e-8f, -2);
    NearestHit nearest(beside, {0, 0, 1});
    EXPECT_FALSE(nearest.take(kLower, offered(0, 0, 2), kBothSides));
    ASSERT_TRUE(nearest.inDoubt());
    EXPECT_TRUE(nearest.doubt().back);
}

TEST(NearestHit, RaysAroundAreAHairBesideItAlsoWhereTheTriangleTouchesItsOrigin) {
    const glm::vec3 from(0.25f, 0.25f + 3e-8f, 0), direction(0.1f, 0, -3);
    NearestHit nearest(from, direction);
    EXPECT_FALSE(nearest.take(kLower, offered(0, 0, 0), kFront));
    ASSERT_TRUE(nearest.inDoubt());
    glm::vec3 sum(0);
    for (int i = 0; i < NearestHit::kAround; ++i) {
        const glm::vec3 beside = nearest.beside(1e-4f, i);
        EXPECT_NEAR(glm::length(beside), 1e-4, 1e-9);
        EXPECT_NEAR(glm::dot(beside, direction), 0, 1e-9);
        sum += beside;
    }
    EXPECT_NEAR(glm::length(sum), 0, 1e-9) << "on all sides";
}

} // namespace

} // namespace penumbra
