// Entries go from block to block and keep what they say.
#include "radiosity/rows/EntryCarrier.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

namespace penumbra {

namespace {

constexpr std::uint32_t kBlocks = 3, kObjects = 6;

/// A row of all kinds of entries, some of them missing.
Row rowOf(std::uint32_t seed) {
    std::mt19937 random(seed);
    Row row;
    row.resize(kBlocks);
    for (RowBlock& block : row) {
        std::vector<RowBlock::Draft> drafts(RowBlock::kSize);
        for (RowBlock::Draft& draft : drafts) {
            const std::uint32_t kind = random() % 4;
            draft.begin(kind == 0 ? 0 : float(random() % 1000 + 1) / 1000);
            if (kind == 1) draft.visible = ~std::uint64_t(0);
            if (kind < 2) continue;
            draft.visible = kind == 2 ? 0 : 0x00ff;
            draft.visibility = kind == 2 ? 0.0f : 0.5f;
            for (int sample = 8; sample < 16; ++sample) draft.block(random() % kObjects, sample);
        }
        block.assign(drafts);
    }
    return row;
}

bool same(const RowBlock::Entry& now, const RowBlock::Entry& before,
          const std::vector<std::uint32_t>& names) {
    return now.present == before.present && now.formFactor == before.formFactor &&
           now.visible == before.visible && now.visibility == before.visibility &&
           std::ranges::equal(now.blockers, before.blockers, [&](Blocker n, Blocker b) {
               return n.object == names[b.object] && n.samples == b.samples;
           });
}

/// Other names for the objects; some need more bytes.
std::vector<std::uint32_t> otherNames(bool wide) {
    std::vector<std::uint32_t> names(kObjects);
    std::iota(names.begin(), names.end(), wide ? 65533u : 2u);
    return names;
}

} // namespace

TEST(EntryCarrier, PutsABlockTogetherFromEntriesOfSeveral) {
    for (std::uint32_t seed = 0; seed < 50; ++seed) {
        const Row before = rowOf(seed);
        const auto names = otherNames(seed % 2 == 0);
        std::mt19937 random(seed);
        std::vector<std::uint32_t> from(RowBlock::kSize);
        for (std::uint32_t& f : from) f = random() % (RowBlock::kSize * (kBlocks + 1));
        from[7] = EntryCarrier::kNew;
        EntryCarrier carrier(names);
        RowBlock block;
        const std::uint64_t known = carrier.carry(before, from, block);
        for (std::uint32_t r = 0; r < RowBlock::kSize; ++r) {
            const bool was = from[r] / RowBlock::kSize < kBlocks;
            EXPECT_EQ(known >> r & 1, std::uint64_t(was));
            if (!was) {
                EXPECT_FALSE(block.entry(int(r)).present);
                continue;
            }
            EXPECT_TRUE(same(
                block.entry(int(r)),
                before[from[r] / RowBlock::kSize].entry(int(from[r] % RowBlock::kSize)), names))
                << seed << " " << r;
        }
    }
}

TEST(EntryCarrier, GivesTheObjectsOfAWholeBlockTheirNewNames) {
    for (const bool wide : {false, true}) {
        const Row before = rowOf(1);
        const auto names = otherNames(wide);
        const RowBlock block = EntryCarrier(names).whole(before[1].copy());
        for (int r = 0; r < RowBlock::kSize; ++r)
            EXPECT_TRUE(same(block.entry(r), before[1].entry(r), names)) << r;
    }
}

} // namespace penumbra
