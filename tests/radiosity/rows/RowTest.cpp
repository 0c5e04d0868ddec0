// The shadow-form-factor-list's compact entries.
#include "radiosity/rows/Row.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <map>

namespace penumbra {

namespace {

using Draft = RowBlock::Draft;

std::uint64_t anyMask() {
    return *rc::gen::resize(rc::kNominalSize, rc::gen::arbitrary<std::uint64_t>());
}

/// An entry of any kind: absent, wholly visible, wholly blocked by one object, or mixed; of 16
/// samples or of 64; objects with small numbers or large.
Draft anyDraft() {
    Draft draft;
    draft.begin(0);
    const int kind = *rc::gen::inRange(0, 5);
    if (kind == 0) return draft;
    draft.begin(float(*rc::gen::inRange(1, 1000)) / 1000);
    const int samples = *rc::gen::arbitrary<bool>() ? 16 : 64;
    const std::uint32_t firstObject = *rc::gen::element(0u, 65533u, 1000000u);
    if (kind == 1) {
        draft.visible = ~std::uint64_t(0);
    } else if (kind == 2) {
        draft.visibility = 0;
        draft.block(firstObject, *rc::gen::inRange(0, samples));
    } else if (kind == 3) { // every sample is either visible or has a blocker, as rays leave it
        draft.visible = (anyMask() | 1) & ~std::uint64_t(2) & ~std::uint64_t(0) >> (64 - samples);
        draft.visibility = float(*rc::gen::inRange(1, 1000)) / 1000;
        for (int k = 0; k < samples; ++k)
            if (!(draft.visible >> k & 1))
                draft.block(firstObject + std::uint32_t(*rc::gen::inRange(0, 5)), k);
    } else {
        const int blocked = *rc::gen::inRange(2, 20);
        for (int i = 0; i < blocked; ++i)
            draft.block(firstObject + std::uint32_t(*rc::gen::inRange(0, 5)),
                        *rc::gen::inRange(0, samples));
        draft.visible = *rc::gen::arbitrary<bool>() ? anyMask() >> (64 - samples) : 0;
        draft.visibility = draft.visible ? float(*rc::gen::inRange(1, 1000)) / 1000 : 0.0f;
    }
    return draft;
}

/// A block whose sender is an emitter, or sends evenly, or from quarters or cells, of which entries
/// have shares.
std::vector<Draft> anyDrafts() {
    std::vector<Draft> drafts(std::size_t(*rc::gen::inRange(0, RowBlock::kSize + 1)));
    const auto sharing = *rc::gen::element(RowBlock::Sharing::emitter, RowBlock::Sharing::even,
                                           RowBlock::Sharing::quarters, RowBlock::Sharing::cells);
    const bool all = RowBlock::hasShares(sharing) && *rc::gen::arbitrary<bool>();
    for (Draft& draft : drafts) {
        draft = anyDraft();
        if (!(draft.formFactor > 0)) continue;
        draft.formFactor *= *rc::gen::element(1.0f, 0.01f, 0.0001f); // of 16, 4 samples, or one
        draft.sharing = sharing;
        if (sharing != RowBlock::Sharing::emitter) { // as a PatchRowBuilder rounds them
            draft.formFactor = SmallFloat(draft.formFactor);
            if (draft.visibility > 0) draft.visibility = SmallFloat(draft.visibility);
        }
        draft.allSamples = all;
        if (draft.blockerCount > 0 && draft.visible == 0) continue;
        const std::size_t count = RowBlock::shareCount(sharing, samplesFor(draft.formFactor, all));
        for (std::size_t i = 0; i < count; ++i)
            draft.shares[i] = *rc::gen::inRange<std::uint8_t>(0, 16);
    }
    return drafts;
}

/// Wholly visible, or wholly blocked by one.
bool simple(const Draft& draft) {
    return draft.blockerCount == 0 || (draft.visible == 0 && draft.blockerCount == 1);
}

RC_GTEST_PROP(Row, GivesBackWhatWasAssigned, ()) {
    const std::vector<Draft> drafts = anyDrafts();
    RowBlock block;
    block.assign(drafts);
    int present = 0;
    for (std::size_t i = 0; i < drafts.size(); ++i) {
        const Draft& draft = drafts[i];
        const RowBlock::Entry entry = block.entry(int(i));
        RC_ASSERT(entry.present == (draft.formFactor > 0));
        if (!entry.present) continue;
        ++present;
        RC_ASSERT(entry.formFactor == draft.formFactor);
        RC_ASSERT(entry.visibility == draft.visibility);
        RC_ASSERT(entry.visible == draft.visible);
        RC_ASSERT(int(entry.blockers.size()) == draft.blockerCount);
        for (std::size_t b = 0; b < entry.blockers.size(); ++b) {
            RC_ASSERT(entry.blockers[b].object == draft.blockers[b].object);
            if (!simple(draft)) RC_ASSERT(entry.blockers[b].samples == draft.blockers[b].samples);
        }
    }
    RC_ASSERT(block.entryCount() == present);
}

RC_GTEST_PROP(Row, VisitsWhatIsSeenInOrder, ()) {
    const std::vector<Draft> drafts = anyDrafts();
    RowBlock block;
    block.assign(drafts);
    std::vector<std::pair<int, float>> expected, visited;
    for (std::size_t i = 0; i < drafts.size(); ++i) {
        const float factor = drafts[i].formFactor * drafts[i].visibility;
        if (factor > 0) expected.emplace_back(int(i), factor);
    }
    block.forEach([&](int receiver, float factor) {
        if (factor > 0) visited.emplace_back(receiver, factor);
    });
    RC_ASSERT(visited == expected);
}

RC_GTEST_PROP(Row, VisitsTheSharesOfWhatIsSeen, ()) {
    const std::vector<Draft> drafts = anyDrafts();
    RowBlock block;
    block.assign(drafts);
    block.forEachShared([&](int receiver, float, RowBlock::Shares shares) {
        const Draft& draft = drafts[std::size_t(receiver)];
        RC_ASSERT(shares.samples == samplesFor(draft.formFactor, draft.allSamples));
        RC_ASSERT(shares.bytes.size() == RowBlock::shareCount(draft.sharing, shares.samples));
        RC_ASSERT(
            std::ranges::equal(shares.bytes, std::span(draft.shares).first(shares.bytes.size())));
    });
}

RC_GTEST_PROP(Row, DecodedAndAssignedAgainIsTheSameToTheLastByte, ()) {
    const std::vector<Draft> drafts = anyDrafts();
    RowBlock block, again;
    block.assign(drafts);
    std::vector<Draft> decoded(drafts.size());
    block.decode(decoded);
    again.assign(decoded);
    RC_ASSERT(again == block);
}

RC_GTEST_PROP(Row, DecodesIntoWhatWasAssigned, ()) {
    const std::vector<Draft> drafts = anyDrafts();
    RowBlock block;
    block.assign(drafts);
    std::vector<Draft> decoded(drafts.size());
    for (Draft& draft : decoded) draft.block(1, 2); // left over from other use
    block.decode(decoded);
    for (std::size_t i = 0; i < drafts.size(); ++i) {
        const Draft &from = drafts[i], &to = decoded[i];
        RC_ASSERT(to.formFactor == from.formFactor);
        if (!(from.formFactor > 0)) continue;
        RC_ASSERT(to.visibility == from.visibility);
        RC_ASSERT(to.blockerCount == from.blockerCount);
        RC_ASSERT(to.sharing == from.sharing);
        RC_ASSERT(to.allSamples == from.allSamples);
        RC_ASSERT(to.shares == from.shares);
        RC_ASSERT(to.visible == (from.blockerCount == 0 ? ~std::uint64_t(0) : from.visible));
        for (std::size_t b = 0; b < std::size_t(to.blockerCount); ++b) {
            RC_ASSERT(to.blockers[b].object == from.blockers[b].object);
            RC_ASSERT(to.blockers[b].samples ==
                      (simple(from) ? ~std::uint64_t(0) : from.blockers[b].samples));
        }
    }
}

RC_GTEST_PROP(Row, NamesEachBlockerOnce, ()) {
    const std::vector<Draft> drafts = anyDrafts();
    RowBlock block;
    block.assign(drafts);
    std::map<std::uint32_t, int> expected, named;
    for (const Draft& draft : drafts)
        for (int b = 0; draft.formFactor > 0 && b < draft.blockerCount; ++b)
            expected[draft.blockers[std::size_t(b)].object] = 1;
    block.forEachBlocker([&](std::uint32_t object) { ++named[object]; });
    RC_ASSERT(named == expected);
    for (const std::uint32_t object : {0u, 1u, 65533u, 65536u, 1000000u, 1000007u})
        RC_ASSERT(block.blockedBy(object) == (expected.count(object) > 0));
}

RC_GTEST_PROP(Row, KnowsItsLargestFormFactor, ()) {
    const std::vector<Draft> drafts = anyDrafts();
    RowBlock block;
    block.assign(drafts);
    float largest = 0;
    for (const Draft& draft : drafts) largest = std::max(largest, draft.formFactor);
    RC_ASSERT(block.largestFormFactor() == largest);
}

RC_GTEST_PROP(Row, OfOtherBlockersHasTheSameMasks, ()) {
    std::vector<Draft> drafts = anyDrafts();
    RowBlock block, other;
    block.assign(drafts);
    for (Draft& draft : drafts)
        for (Blocker& blocker : std::span(draft.blockers).first(std::size_t(draft.blockerCount)))
            blocker.object += 100;
    other.assign(drafts);
    RC_ASSERT(block.sameMasks(other));
    RC_ASSERT(other.sameMasks(block));
}

RC_GTEST_PROP(Row, OfOneOtherVisibleSampleHasOtherMasks, ()) {
    std::vector<Draft> drafts = anyDrafts();
    Draft mixed;
    mixed.begin(0.5f);
    mixed.block(3, 0);
    mixed.visible = 0b110;
    mixed.visibility = 0.5f;
    drafts.resize(std::min<std::size_t>(drafts.size(), RowBlock::kSize - 1));
    drafts.push_back(mixed);
    RowBlock block, other;
    block.assign(drafts);
    drafts.back().visible ^= std::uint64_t(1) << *rc::gen::inRange(1, 64);
    other.assign(drafts);
    RC_ASSERT(!block.sameMasks(other));
}

RC_GTEST_PROP(Row, CountsItsEntriesAndBytes, ()) {
    const std::vector<Draft> drafts = anyDrafts();
    Row row;
    row.resize(2);
    for (RowBlock& block : row) block.assign(drafts);
    RC_ASSERT(sizeOf(row).bytes == 2 * row[0].bytes());
    RC_ASSERT(sizeOf(row).entries == 2 * std::size_t(row[0].entryCount()));
}

TEST(Row, OfMoreObjectsThanAByteCanNameKeepsThemApart) {
    // Up to 64 blockers of each of 64 entries: the most there can be.
    for (const int each : {1, 3, 4, 5, 64})
        for (const std::uint32_t first : {0u, 70000u}) {
            std::vector<Draft> drafts(RowBlock::kSize);
            std::uint32_t object = first;
            for (Draft& draft : drafts) {
                draft.begin(0.5f);
                for (int b = 0; b < each; ++b) draft.block(object++, b);
                draft.visible = each < 64 ? std::uint64_t(1) << 63 : 0;
                draft.visibility = each < 64 ? 0.25f : 0;
            }
            RowBlock block, again;
            block.assign(drafts);
            std::uint32_t expected = first;
            block.forEachBlocker([&](std::uint32_t o) { EXPECT_EQ(o, expected++); });
            EXPECT_EQ(expected, object);
            std::vector<Draft> decoded(RowBlock::kSize);
            block.decode(decoded);
            for (std::size_t i = 0; i < drafts.size(); ++i) {
                ASSERT_EQ(decoded[i].blockerCount, each);
                for (std::size_t b = 0; b < std::size_t(each); ++b) {
                    EXPECT_EQ(decoded[i].blockers[b].object, drafts[i].blockers[b].object);
                    EXPECT_EQ(decoded[i].blockers[b].samples, drafts[i].blockers[b].samples);
                }
            }
            again.assign(decoded);
            EXPECT_TRUE(again == block);
        }
}

TEST(Row, WithoutEntriesTakesEightBytes) {
    RowBlock block;
    EXPECT_EQ(block.bytes(), 8u);
    block.assign(std::vector<Draft>(RowBlock::kSize));
    EXPECT_EQ(block.bytes(), 8u);
    EXPECT_EQ(block.largestFormFactor(), 0.0f);
    EXPECT_FALSE(block.blockedBy(0));
}

TEST(Row, OfEntriesBlockedByOneTakesLessThanSixBytesAnEntry) {
    std::vector<Draft> drafts(RowBlock::kSize);
    for (Draft& draft : drafts) {
        draft.begin(0.01f);
        draft.block(5, 0);
    }
    RowBlock block;
    block.assign(drafts);
    EXPECT_LT(double(block.bytes()) / RowBlock::kSize, 6);
}

TEST(Row, PenumbraOfOneBlockerTakesTenBytesMoreThanItsFormFactorAndVisibility) {
    // A code, the visible samples of 64, the blocker's index; its samples are all the others.
    std::vector<Draft> drafts(1);
    drafts[0].begin(0.01f);
    for (int k = 0; k < 40; ++k) drafts[0].block(5, k);
    drafts[0].visible = ~std::uint64_t(0) << 40;
    drafts[0].visibility = 0.375f;
    RowBlock block, two;
    block.assign(drafts);
    drafts.push_back(drafts[0]);
    two.assign(drafts);
    EXPECT_EQ(two.bytes() - block.bytes(), 4u + 4u + 10u);
}

TEST(Row, OfVisibleEntriesTakesNoMoreThanFiveBytesAnEntry) {
    std::vector<Draft> drafts(RowBlock::kSize);
    for (Draft& draft : drafts) draft.begin(0.01f);
    RowBlock block;
    block.assign(drafts);
    EXPECT_EQ(block.entryCount(), RowBlock::kSize);
    EXPECT_LE(double(block.bytes()) / RowBlock::kSize, 5);
}

TEST(Row, HasOnlyTheEntriesThatCount) {
    std::vector<Draft> drafts(3);
    for (Draft& draft : drafts) draft.begin(0.25f);
    RowBlock block;
    block.assign(drafts, 0b101);
    EXPECT_EQ(block.present(), 0b101u);
}

TEST(Row, AssignedAgainForgetsWhatWasThere) {
    std::vector<Draft> drafts(3);
    for (Draft& draft : drafts) draft.begin(0.25f);
    RowBlock block;
    block.assign(drafts);
    block.assign({});
    EXPECT_EQ(block.entryCount(), 0);
    EXPECT_FALSE(block.entry(1).present);
}

TEST(Row, DraftGathersTheSamplesOfEachBlocker) {
    Draft draft;
    draft.begin(1);
    draft.block(7, 0);
    draft.block(9, 63);
    draft.block(7, 5);
    ASSERT_EQ(draft.blockerCount, 2);
    EXPECT_EQ(draft.blockers[0].object, 7u);
    EXPECT_EQ(draft.blockers[0].samples, 0b100001u);
    EXPECT_EQ(draft.blockers[1].samples, std::uint64_t(1) << 63);
}

} // namespace

} // namespace penumbra
