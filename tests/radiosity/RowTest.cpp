// The shadow-form-factor-list's compact entries.
#include "radiosity/Row.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

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
    const int kind = *rc::gen::inRange(0, 4);
    if (kind == 0) return draft;
    draft.begin(float(*rc::gen::inRange(1, 1000)) / 1000);
    const int samples = *rc::gen::arbitrary<bool>() ? 16 : 64;
    const std::uint32_t firstObject = *rc::gen::element(0u, 65533u, 1000000u);
    if (kind == 1) {
        draft.visible = ~std::uint64_t(0);
    } else if (kind == 2) {
        draft.visibility = 0;
        draft.block(firstObject, *rc::gen::inRange(0, samples));
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

std::vector<Draft> anyDrafts() {
    std::vector<Draft> drafts(std::size_t(*rc::gen::inRange(0, RowBlock::kSize + 1)));
    for (Draft& draft : drafts) draft = anyDraft();
    return drafts;
}

/// Wholly visible, or wholly blocked by one.
bool simple(const Draft& draft) {
    return draft.blockerCount == 0 || (draft.visible == 0 && draft.blockerCount == 1);
}

/// Whether 16 bits hold its samples and its objects.
bool narrow(const Draft& draft) {
    std::uint64_t wide = draft.visible >> 16;
    for (const Blocker& blocker : std::span(draft.blockers).first(std::size_t(draft.blockerCount)))
        wide |= blocker.samples >> 16 | blocker.object >> 16;
    return wide == 0;
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

RC_GTEST_PROP(Row, TakesTheBytesOfItsLayout, ()) {
    // One word a form factor and one a code; narrow and wide side records as Row.h describes them.
    const std::vector<Draft> drafts = anyDrafts();
    Row row(2);
    for (RowBlock& block : row) block.assign(drafts);
    std::size_t words = 0;
    for (const Draft& draft : drafts) {
        if (!(draft.formFactor > 0)) continue;
        words += draft.blockerCount == 0 ? 1 : 2;
        const auto blockers = std::size_t(draft.blockerCount);
        if (simple(draft)) continue;
        words += narrow(draft) ? 1 + (draft.visible != 0) + blockers : 4 + 3 * blockers;
    }
    RC_ASSERT(row[0].bytes() == sizeof(RowBlock) + 4 * words);
    RC_ASSERT(sizeOf(row).bytes == 2 * row[0].bytes());
    RC_ASSERT(sizeOf(row).entries == 2 * std::size_t(row[0].entryCount()));
}

TEST(Row, OfVisibleEntriesTakesNoMoreThanFiveBytesAnEntry) {
    std::vector<Draft> drafts(RowBlock::kSize);
    for (Draft& draft : drafts) draft.begin(0.01f);
    RowBlock block;
    block.assign(drafts);
    EXPECT_EQ(block.entryCount(), RowBlock::kSize);
    EXPECT_LE(double(block.bytes()) / RowBlock::kSize, 5);
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
