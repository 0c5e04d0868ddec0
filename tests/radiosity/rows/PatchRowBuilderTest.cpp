// Which pairs of a patch and a receiver have an entry.
#include "radiosity/rows/PatchRowBuilder.h"
#include "radiosity/rows/SenderSamples.h"
#include "tests/support/Scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace penumbra {

namespace {

constexpr float kLeast = kLeastFactor;

/// A square metre on the floor that faces up, and receivers above its middle that face down.
struct PatchBelow : ::testing::Test {
    PatchBelow() {
        patch.normal = {0, 0, 1};
        patch.area = 1;
        patch.cornerCount = 4;
        for (std::size_t k = 0; k < samples.size(); ++k)
            samples[k] = {float(k % 4) / 4 - 0.375f, float(k / 4) / 4 - 0.375f, 0};
    }
    /// Entries of receivers so high that the patch has this form factor there. \param blocks how
    /// many
    std::vector<RowBlock::Entry> entries(float formFactor, std::uint32_t blocks,
                                         float least = kLeast) {
        const float height = 1 / std::sqrt(std::numbers::pi_v<float> * formFactor);
        const std::vector<Receiver> receivers(RowBlock::kSize, {{0, 0, height}, {0, 0, -1}});
        const Bounds box{{-0.5f, -0.5f, 0}, {0.5f, 0.5f, 0}};
        PatchSender sender;
        sender.patch = &patch;
        sender.outline = outline;
        sender.samples = samples.data();
        sender.box = &box;
        sender.key = 7;
        sender.least = least;
        std::vector<RowBlock::Entry> found;
        for (std::uint32_t b = 0; b < blocks; ++b) {
            std::vector<std::uint32_t> keys;
            for (std::uint32_t r = 0; r < RowBlock::kSize; ++r) keys.push_back(b << 16 | r);
            RowBlock block;
            builder.build(sender, {receivers, ~std::uint64_t(0), keys}, block);
            for (int r = 0; r < RowBlock::kSize; ++r)
                if (block.entry(r).present) found.push_back(block.entry(r));
        }
        return found;
    }

    Patch patch;
    std::array<glm::vec3, kPatchSamples> samples;
    const std::vector<glm::vec3> outline{
        {-0.5f, -0.5f, 0}, {0.5f, -0.5f, 0}, {0.5f, 0.5f, 0}, {-0.5f, 0.5f, 0}};
    const RayScene nothing{std::span<const RayMesh>{}};
    PatchRowBuilder builder{nothing};
};

TEST_F(PatchBelow, IsEnteredWithItsFormFactorWhereItMatters) {
    const auto found = entries(2 * kLeast, 1);
    ASSERT_EQ(found.size(), 64u);
    for (const RowBlock::Entry& entry : found)
        EXPECT_NEAR(entry.formFactor, 2 * kLeast, 0.01f * kLeast);
}

/// As a card of 5 cm has 6 m away: right beside a bulb it may be what lights a room, and a draw
/// would be a blotch of a third.
TEST_F(PatchBelow, IsEnteredWithItsFormFactorWhereItIsBright) {
    const auto found = entries(2e-5f, 1, kLeastOfBright);
    ASSERT_EQ(found.size(), 64u);
    for (const RowBlock::Entry& entry : found) EXPECT_NEAR(entry.formFactor, 2e-5f, 1e-7f);
}

TEST_F(PatchBelow, SendsAsMuchInTheMeanWhereItHardlyMatters) {
    for (const float formFactor : {0.5f * kLeast, 0.1f * kLeast, 0.02f * kLeast}) {
        constexpr std::uint32_t kBlocks = 400;
        const auto found = entries(formFactor, kBlocks);
        for (const RowBlock::Entry& entry : found) EXPECT_EQ(entry.formFactor, kLeast);
        const float mean = kLeast * float(found.size()) / float(RowBlock::kSize * kBlocks);
        const float share = formFactor / kLeast; // that has an entry: a binomial's
        const float deviation = std::sqrt((1 - share) / (share * RowBlock::kSize * kBlocks));
        EXPECT_NEAR(mean / formFactor, 1, 4 * deviation) << formFactor;
    }
}

TEST_F(PatchBelow, IsDrawnTheSameEveryTime) {
    const auto once = entries(0.3f * kLeast, 4), again = entries(0.3f * kLeast, 4);
    EXPECT_EQ(once.size(), again.size());
    EXPECT_GT(once.size(), 0u);
}

TEST_F(PatchBelow, IsLeftOutWhereItSendsNextToNothing) {
    EXPECT_TRUE(entries(0.5f * kNoFactor, 100).empty());
}

} // namespace

} // namespace penumbra
