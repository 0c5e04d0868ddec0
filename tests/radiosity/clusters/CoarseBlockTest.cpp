#include "radiosity/clusters/CoarseBlock.h"

#include <gtest/gtest.h>

#include <bit>
#include <vector>

namespace penumbra {

namespace {

/// 8 x 8 points, a unit apart.
std::vector<glm::vec3> grid() {
    std::vector<glm::vec3> points;
    for (int i = 0; i < 64; ++i) points.emplace_back(i % 8, i / 8, 0);
    return points;
}

TEST(CoarseBlock, GuessesAConstantExactlyAndARampNearly) {
    const std::vector<glm::vec3> points = grid();
    const CoarseBlock block = coarseBlock(points, std::vector(64, glm::vec3(0, 0, 1)));
    EXPECT_LE(std::popcount(block.chosen), 16);
    EXPECT_GE(std::popcount(block.chosen), 9);
    const std::vector<float> constant(64, 3);
    std::vector<float> ramp;
    for (const glm::vec3& point : points) ramp.push_back(point.x);
    for (std::size_t p = 0; p < 64; ++p) {
        EXPECT_FLOAT_EQ(block.guess(constant, p), 3);
        EXPECT_NEAR(block.guess(ramp, p), ramp[p], 1.5f);
        if (block.chosen >> p & 1) EXPECT_EQ(block.guess(ramp, p), ramp[p]);
    }
}

TEST(CoarseBlock, GuessesNothingFromWhatIsTurnedAnotherWay) {
    std::vector<glm::vec3> normals;
    for (int i = 0; i < 64; ++i) normals.emplace_back(0, 0, i % 2 ? 1 : -1);
    const CoarseBlock block = coarseBlock(grid(), normals);
    for (std::size_t p = 0; p < 64; ++p) EXPECT_EQ(block.nearest[p] % 2, p % 2);
}

TEST(CoarseBlock, ChoosesNoneOfThoseThatThereAreNot) {
    const CoarseBlock block =
        coarseBlock(grid(), std::vector(64, glm::vec3(0, 0, 1)), std::uint64_t(0xff00));
    EXPECT_NE(block.chosen, 0u);
    EXPECT_EQ(block.chosen & ~std::uint64_t(0xff00), 0u);
    EXPECT_EQ(coarseBlock({}, {}).chosen, 0u);
}

} // namespace

} // namespace penumbra
