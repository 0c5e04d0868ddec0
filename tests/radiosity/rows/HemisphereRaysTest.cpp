// The bundle of rays for cosine-weighted means over a hemisphere.
#include "radiosity/rows/HemisphereRays.h"
#include "tests/scenegraph/RandomParts.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <set>

namespace penumbra {

namespace {

RC_GTEST_PROP(HemisphereRays, AreUnitAndAboveTheHorizonOfAnyNormal, ()) {
    const glm::vec3 normal(direction());
    const HemisphereRays rays(64);
    for (int i = 0; i < rays.count(); ++i) {
        RC_ASSERT(std::abs(glm::length(rays.direction(i, normal)) - 1) < 1e-5f);
        RC_ASSERT(glm::dot(rays.direction(i, normal), normal) > 0);
    }
}

RC_GTEST_PROP(HemisphereRays, HaveTheMeansOfTheCosine, ()) {
    // Weighted by the cosine, the mean direction is 2/3 of the normal, and the mean of cos^2 is
    // 1/2.
    const glm::vec3 normal(direction());
    const HemisphereRays rays(64);
    glm::vec3 mean(0);
    double square = 0;
    for (int i = 0; i < rays.count(); ++i) {
        const glm::vec3 d = rays.direction(i, normal);
        mean += d / float(rays.count());
        square += double(glm::dot(d, normal)) * glm::dot(d, normal) / rays.count();
    }
    RC_ASSERT(glm::distance(mean, normal * (2.0f / 3)) < 0.02f);
    RC_ASSERT(std::abs(square - 0.5) < 0.01);
}

TEST(HemisphereRays, AreSpreadInEveryPrefixOfFourAndSixteen) {
    // The first four lie in the four quarters of the hemisphere; four times as many, in 4 x 4
    // strata.
    const HemisphereRays rays(64);
    std::set<std::pair<bool, bool>> quarters;
    glm::vec3 mean(0);
    for (int i = 0; i < 16; ++i) {
        const glm::vec3 d = rays.direction(i, {0, 0, 1});
        if (i < 4) quarters.emplace(d.x > 0, d.y > 0);
        mean += d / 16.0f;
    }
    EXPECT_EQ(quarters.size(), 4u);
    EXPECT_LT(glm::distance(mean, {0, 0, 2.0f / 3}), 0.1f);
}

TEST(HemisphereRays, RunAlongTheSurfaceNoMoreOftenThanTheCosineHasIt) {
    // The share of rays flatter than an angle is its sine squared. In a slit a ray along the
    // surface finds the light outside: some too many, and the slit glows.
    const HemisphereRays rays(4096);
    for (const float sine : {0.02f, 0.05f, 0.1f, 0.2f}) {
        int flatter = 0;
        for (int i = 0; i < rays.count(); ++i) flatter += rays.direction(i, {0, 0, 1}).z < sine;
        EXPECT_NEAR(float(flatter) / 4096, sine * sine, 1e-3f) << sine;
    }
}

RC_GTEST_PROP(HemisphereRays, TowardsASphereAreAllThatPassItAndFewOthers, ()) {
    const glm::vec3 normal(direction());
    const auto share = [] { return float(*rc::gen::inRange(1, 1000)) / 1000; };
    const glm::vec3 away = 3 * share() * glm::vec3(direction());
    const float radius = share();
    const HemisphereRays rays(64);
    const std::uint64_t bits = rays.towards(away, radius, normal);
    for (int i = 0; i < rays.count(); ++i) {
        const glm::dvec3 d(rays.direction(i, normal)), c(away);
        const double along = glm::dot(d, c), aside2 = glm::dot(c, c) - along * along;
        const bool inside = glm::dot(c, c) <= double(radius) * radius;
        const bool passes = inside || (along >= 0 && aside2 <= double(radius) * radius);
        const bool taken = bits >> i & 1;
        RC_ASSERT(!passes || taken);
        const double wide = radius + 0.02;
        const bool near =
            glm::dot(c, c) <= wide * wide || (along >= -0.02 && aside2 <= wide * wide);
        RC_ASSERT(!taken || near);
    }
}

} // namespace

} // namespace penumbra
