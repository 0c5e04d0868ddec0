// Regions between boxes, against the boxes and rays that sweep them out.
#include "radiosity/rays/Shaft.h"

#include <gtest/gtest.h>

#include <random>

namespace penumbra {

namespace {

constexpr int kBoxes = 4000, kSteps = 400;

class RandomBoxes {
public:
    float number() { return float(random_()) / float(0xffffffffu); } // in [0, 1]
    glm::vec3 point() { return {number(), number(), number()}; }
    /// In the unit cube; one in four is flat, one in four is a point.
    Bounds box() {
        const glm::vec3 corner = point();
        glm::vec3 size = 0.3f * point();
        const auto kind = random_() % 4;
        if (kind == 0) size[int(random_() % 3)] = 0;
        if (kind == 1) size = glm::vec3(0);
        return {corner, corner + size};
    }
    glm::vec3 pointIn(const Bounds& box) { return box.lower + point() * box.size(); }

private:
    std::mt19937 random_;
};

/// Whether one of many boxes (1 - t) a + t b meets the target.
bool sampledShaftMeets(const Bounds& a, const Bounds& b, const Bounds& target) {
    for (int i = 0; i <= kSteps; ++i) {
        const float t = float(i) / kSteps;
        if (Bounds{glm::mix(a.lower, b.lower, t), glm::mix(a.upper, b.upper, t)}.overlaps(target))
            return true;
    }
    return false;
}

TEST(Shaft, MeetsWhateverABoxBetweenItsEndsMeets) {
    RandomBoxes random;
    int met = 0;
    for (int i = 0; i < kBoxes; ++i) {
        const Bounds a = random.box(), b = random.box(), target = random.box();
        if (!sampledShaftMeets(a, b, target)) continue;
        ++met;
        // A hair for rounding: callers grow the boxes of what moves by more than that.
        EXPECT_TRUE(shaftMeets(a, b, grown(target, 1e-5f)));
    }
    EXPECT_GT(met, kBoxes / 40);
}

TEST(Shaft, MeetsNothingElse) {
    RandomBoxes random;
    int missed = 0;
    for (int i = 0; i < kBoxes; ++i) {
        const Bounds a = random.box(), b = random.box(), target = random.box();
        const bool meets = shaftMeets(a, b, target);
        missed += !meets;
        // Between two samples of t a corner moves by less than 1.3 / kSteps.
        if (meets) {
            EXPECT_TRUE(sampledShaftMeets(a, b, grown(target, 1.3f / kSteps)));
        }
    }
    EXPECT_GT(missed, kBoxes / 2);
}

TEST(Shaft, MeetsWhateverARayBetweenItsEndsMeets) {
    RandomBoxes random;
    for (int i = 0; i < kBoxes; ++i) {
        const Bounds a = random.box(), b = random.box();
        const glm::vec3 between = glm::mix(random.pointIn(a), random.pointIn(b), random.number());
        EXPECT_TRUE(shaftMeets(a, b, grown({between, between}, 1e-5f)));
    }
}

TEST(Shaft, BetweenABoxAndItselfIsTheBox) {
    const Bounds box{{0, 0, 0}, {1, 1, 1}};
    EXPECT_TRUE(shaftMeets(box, box, {{1, 1, 1}, {2, 2, 2}}));
    EXPECT_FALSE(shaftMeets(box, box, {{1.001f, 1, 1}, {2, 2, 2}}));
}

TEST(Shaft, MeetsNoEmptyBox) {
    RandomBoxes random;
    for (int i = 0; i < 100; ++i) EXPECT_FALSE(shaftMeets(random.box(), random.box(), Bounds()));
}

TEST(Shaft, RaysBetweenTwoDirectionsMeetWhateverOneOfThemMeets) {
    RandomBoxes random;
    for (int i = 0; i < kBoxes; ++i) {
        const Bounds from = random.box();
        Bounds directions = random.box();
        directions.lower -= glm::vec3(0.5f), directions.upper -= glm::vec3(0.5f);
        const glm::vec3 there =
            random.pointIn(from) + 10 * random.number() * random.pointIn(directions);
        EXPECT_TRUE(
            raysMeet(from, directions.lower, directions.upper, grown({there, there}, 1e-4f)));
    }
    const Bounds unit{{0, 0, 0}, {1, 1, 1}};
    EXPECT_FALSE(raysMeet(unit, {0, 0, 1}, {0.1f, 0.1f, 1}, {{0, 0, -2}, {1, 1, -1}}));
    EXPECT_FALSE(raysMeet(unit, {0, 0, 1}, {0.1f, 0.1f, 1}, {{2, 0, 5}, {3, 1, 6}}));
}

} // namespace

} // namespace penumbra
