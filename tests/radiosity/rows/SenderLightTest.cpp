// What an entry makes of the light of a sender whose parts send unlike each other.
#include "radiosity/rows/SenderLight.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace penumbra {

namespace {

constexpr std::size_t kCells = 16;

/// Cell k sends k + 1, so that sums tell which cells they are of.
std::vector<glm::dvec3> numbered(std::size_t count) {
    std::vector<glm::dvec3> light;
    for (std::size_t k = 0; k < count; ++k) light.emplace_back(double(k + 1), 1, 0);
    return light;
}

TEST(SenderLight, OfOneSampleIsThatOfItsCell) {
    const std::array<std::uint8_t, 1> shares{6};
    EXPECT_EQ(SentLight(numbered(kCells)).seen({shares, 1}), glm::dvec3(7, 1, 0));
}

TEST(SenderLight, OfFourSamplesIsThatOfTheSampledCellOfEachQuarter) {
    // Cells 1, 4, 10 and 15; the first and the last are seen, one to four.
    const std::array<std::uint8_t, 4> shares{0b11100001, 51, 51, 51};
    const glm::dvec3 light = SentLight(numbered(kCells)).seen({shares, 4});
    EXPECT_NEAR(light.x, 0.2 * 2 + 0.8 * 16, 1e-12);
    EXPECT_NEAR(light.y, 1, 1e-12);
}

TEST(SenderLight, OfSixteenSamplesIsTheMeanOverTheCellsThatAreSeen) {
    std::array<std::uint8_t, 15> shares{}; // cells 3 and 4 alike, no other
    for (std::size_t k = 3; k < shares.size(); ++k) shares[k] = k == 3 ? 102 : 204;
    shares[14] = 255;
    const glm::dvec3 light = SentLight(numbered(kCells)).seen({shares, 16});
    EXPECT_NEAR(light.x, 0.4 * 4 + 0.4 * 5 + 0.2 * 15, 1e-12);
    EXPECT_NEAR(light.y, 1, 1e-12);
}

TEST(SenderLight, OfAClusterIsTheMeanOverItsQuartersAndHowMuchMoreLeavesTheSamples) {
    // Quarters send 100, 200, 300 and 400; cell k sends k + 1 more.
    std::vector<glm::dvec3> light = numbered(kClusterCells);
    for (std::size_t q = 0; q < 4; ++q) light[kSenderCells + q] = {100.0 * double(q + 1), 0, 0};
    const std::array<std::uint8_t, 4> one{6, 51, 102, 204};
    EXPECT_NEAR(SentLight(light).seen({one, 1}).x,
                0.2 * 100 + 0.2 * 200 + 0.4 * 300 + 0.2 * 400 + 7, 1e-12);
    const std::array<std::uint8_t, 4> four{0b11100001, 51, 51, 51};
    EXPECT_NEAR(SentLight(light).seen({four, 4}).x, 0.2 * 102 + 0.8 * 416, 1e-12);
    std::array<std::uint8_t, 15> all{}; // cell 9 alone
    for (std::size_t k = 9; k < all.size(); ++k) all[k] = 255;
    EXPECT_NEAR(SentLight(light).seen({all, 16}).x, 310, 1e-12);
}

TEST(SenderLight, OfASenderThatSendsEvenlyIsItsOwn) {
    EXPECT_EQ(SentLight(numbered(1)).first(), glm::dvec3(1, 1, 0));
}

TEST(SenderLight, ReachesTheReceiversOfABlockByTheirShares) {
    std::vector<RowBlock::Draft> drafts(3);
    for (std::size_t i : {0u, 2u}) {
        drafts[i].begin(1e-4f);
        drafts[i].sharing = RowBlock::Sharing::cells;
        drafts[i].shares[0] = std::uint8_t(5 + i);
    }
    RowBlock block;
    block.assign(drafts);
    std::vector<std::pair<int, double>> received;
    forEachReceived(block, SentLight(numbered(kCells)), [&](int r, float factor, glm::dvec3 light) {
        received.emplace_back(r, light.x / double(factor));
    });
    const std::vector<std::pair<int, double>> expected{{0, 6}, {2, 8}};
    EXPECT_EQ(received, expected);
}

} // namespace

} // namespace penumbra
