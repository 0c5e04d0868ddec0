// Near boxes: the same as by looking at all of them.
#include "radiosity/clusters/NearPairs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <tuple>

namespace penumbra {

namespace {

using Pair = std::array<std::uint32_t, 2>;

std::vector<Bounds> randomBoxes(std::size_t count) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> place(0, 2), size(0, 0.2f);
    std::vector<Bounds> boxes(count);
    for (Bounds& box : boxes) {
        const glm::vec3 corner(place(random), place(random), place(random));
        box.add(corner);
        box.add(corner + glm::vec3(size(random), size(random), size(random)));
    }
    boxes[7] = boxes[3]; // a tie
    return boxes;
}

bool mayPair(std::uint32_t a, std::uint32_t b) {
    return (a + b) % 3 != 0;
}

float square(glm::vec3 v) {
    return glm::dot(v, v);
}

TEST(NearPairs, AreThoseOfASearchThroughAll) {
    const std::vector<Bounds> boxes = randomBoxes(300);
    std::set<Pair> expected;
    for (std::uint32_t a = 0; a < boxes.size(); ++a) {
        std::vector<std::tuple<float, float, std::uint32_t>> near;
        for (std::uint32_t b = 0; b < boxes.size(); ++b) {
            const float gap = square(
                glm::max(glm::max(boxes[a].lower - boxes[b].upper, boxes[b].lower - boxes[a].upper),
                         glm::vec3(0)));
            if (a != b && mayPair(a, b) && gap <= 0.1f * 0.1f)
                near.emplace_back(gap, square(boxes[b].centre() - boxes[a].centre()), b);
        }
        std::sort(near.begin(), near.end());
        if (near.size() > 4) near.resize(4);
        for (const auto& [gap, distance, b] : near)
            expected.insert({std::min(a, b), std::max(a, b)});
    }
    const std::vector<Pair> found = nearPairs(boxes, 0.1f, 4, mayPair);
    EXPECT_EQ(found, std::vector<Pair>(expected.begin(), expected.end()));
}

TEST(NearPairs, OfNothingAreNone) {
    EXPECT_TRUE(nearPairs({}, 1, 4, mayPair).empty());
    EXPECT_TRUE(nearPairs(randomBoxes(10), 1, 0, mayPair).empty());
}

} // namespace

} // namespace penumbra
