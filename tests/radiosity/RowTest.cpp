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

/// An entry of any kind: absent, wholly visible, wholly blocked by one object, or mixed.
Draft anyDraft() {
    Draft draft;
    draft.begin(0);
    const int kind = *rc::gen::inRange(0, 4);
    if (kind == 0) return draft;
    draft.begin(float(*rc::gen::inRange(1, 1000)) / 1000);
    if (kind == 1) {
        draft.visible = ~std::uint64_t(0);
    } else if (kind == 2) {
        draft.visibility = 0;
        draft.block(std::uint32_t(*rc::gen::inRange(0, 100000)), *rc::gen::inRange(0, 64));
    } else {
        draft.visible = anyMask();
        draft.visibility = float(*rc::gen::inRange(0, 1000)) / 1000;
        const int blocked = *rc::gen::inRange(2, 20);
        for (int i = 0; i < blocked; ++i)
            draft.block(std::uint32_t(*rc::gen::inRange(0, 5)), *rc::gen::inRange(0, 64));
        if (draft.blockerCount == 1) draft.visible |= 1; // else it were wholly blocked by one
    }
    return draft;
}

std::vector<Draft> anyDrafts() {
    std::vector<Draft> drafts(std::size_t(*rc::gen::inRange(0, RowBlock::kSize + 1)));
    for (Draft& draft : drafts) draft = anyDraft();
    return drafts;
}

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
            RC_ASSERT(entry.blockers[b].samples ==
                      (simple(draft) ? ~std::uint64_t(0) : draft.blockers[b].samples));
        }
    }
    RC_ASSERT(block.entryCount() == present);
}

RC_GTEST_PROP(Row, VisitsWhatIsNotWhollyBlockedInOrder, ()) {
    const std::vector<Draft> drafts = anyDrafts();
    RowBlock block;
    block.assign(drafts);
    std::vector<std::pair<int, float>> expected, visited;
    for (std::size_t i = 0; i < drafts.size(); ++i) {
        const Draft& draft = drafts[i];
        const bool blocked = draft.blockerCount > 0 && simple(draft);
        if (draft.formFactor > 0 && !blocked)
            expected.emplace_back(int(i), draft.formFactor * draft.visibility);
    }
    block.forEach([&](int receiver, float factor) { visited.emplace_back(receiver, factor); });
    RC_ASSERT(visited == expected);
}

RC_GTEST_PROP(Row, TakesTheBytesOfItsLayout, ()) {
    // One word a form factor, one a code, and 4 + 3 a blocker for each mixed entry.
    const std::vector<Draft> drafts = anyDrafts();
    RowBlock block;
    block.assign(drafts);
    std::size_t words = 0;
    for (const Draft& draft : drafts) {
        if (!(draft.formFactor > 0)) continue;
        words += draft.blockerCount == 0 ? 1 : 2;
        if (!simple(draft)) words += 4 + 3 * std::size_t(draft.blockerCount);
    }
    RC_ASSERT(block.bytes() == sizeof(RowBlock) + 4 * words);
    RC_ASSERT(sizeOf(Row{block, block}).bytes == 2 * block.bytes());
    RC_ASSERT(sizeOf(Row{block, block}).entries == 2 * std::size_t(block.entryCount()));
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
