// What an edit changes in a row is found without reading its entries.
#include "radiosity/rows/RowTable.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace penumbra {

namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr std::uint64_t kAll = ~std::uint64_t(0);
const Bounds kSender{{0, 0, 5}, {1, 1, 5}};
const ObjectId kSenderObject{7};

/// Ten blocks side by side on the floor, under a sender above the first of them.
class RowTableOfTenBlocks : public testing::Test {
protected:
    RowTableOfTenBlocks() : table(2) {
        for (int b = 0; b < 10; ++b) table.blocks().append({{b, 0, 0}, {b + 1, 1, 0}});
        for (std::size_t row = 0; row < 2; ++row) table[row].resize(10);
    }
    std::vector<BlockMask> concerned(const PendingChange& change, std::size_t row = 0,
                                     RowTable::Blocks blocks = {},
                                     const RowTable::Hiding& hidden = {}) const {
        return table.concerned(row, kSender, kSenderObject, change, blocks, hidden);
    }
    RowTable table;
};

/// Blocks, and the entries of them to be evaluated anew.
auto is(std::uint32_t block, std::uint64_t receivers) {
    return testing::AllOf(testing::Field(&BlockMask::block, block),
                          testing::Field(&BlockMask::receivers, receivers));
}

TEST_F(RowTableOfTenBlocks, NothingIsConcernedByNoChange) {
    EXPECT_THAT(concerned({}), IsEmpty());
}

TEST_F(RowTableOfTenBlocks, OldShadowsAreFoundByTheirBlocker) {
    const std::vector<RowTable::BlockerNote> notes{{0, 8, 3}, {0, 2, 3}, {0, 2, 3},
                                                   {0, 4, 2}, {0, 5, 4}, {1, 6, 3}};
    table.note(notes);
    const PendingChange gone{{{3, false, {}}}, {}};
    EXPECT_THAT(concerned(gone), ElementsAre(is(2, 0), is(8, 0)));
    EXPECT_THAT(concerned(gone, 1), ElementsAre(is(6, 0)));
}

TEST_F(RowTableOfTenBlocks, NewShadowsAreFoundByTheShaft) {
    // Half way up under the sender, as wide as it is: the shadow falls on the block below it, and
    // on those whose shafts touch its corners.
    const PendingChange here{{{3, true, {{0.2f, 0.2f, 2.5f}, {0.8f, 0.8f, 2.6f}}}}, {}};
    EXPECT_THAT(concerned(here), ElementsAre(is(0, 0), is(1, 0)));
    const PendingChange aside{{{3, true, {{20, 0, 2}, {21, 1, 3}}}}, {}};
    EXPECT_THAT(concerned(aside), IsEmpty());
}

TEST_F(RowTableOfTenBlocks, ARunOfBlocksFindsWhatAllOfThemFindThere) {
    table.note(std::vector<RowTable::BlockerNote>{{0, 8, 3}, {0, 2, 3}});
    const PendingChange change{{{3, true, {{0.2f, 0.2f, 2.5f}, {0.8f, 0.8f, 2.6f}}}},
                               {{1, 0b101}, {9, kAll}}};
    EXPECT_THAT(concerned(change),
                ElementsAre(is(0, 0), is(1, 0b101), is(2, 0), is(8, 0), is(9, kAll)));
    EXPECT_THAT(concerned(change, 0, {1, 8}), ElementsAre(is(1, 0b101), is(2, 0)));
    EXPECT_THAT(concerned(change, 0, {8, 9}), ElementsAre(is(8, 0)));
    const PendingChange sender{{{kSenderObject.value, true, {}}}, {}};
    EXPECT_THAT(concerned(sender, 0, {3, 5}), ElementsAre(is(3, kAll), is(4, kAll)));
}

TEST_F(RowTableOfTenBlocks, WhatIsNowHiddenThrowsNoNewShadow) {
    const PendingChange hidden{{{3, false, {{0.2f, 0.2f, 2.5f}, {0.8f, 0.8f, 2.6f}}}}, {}};
    EXPECT_THAT(concerned(hidden), IsEmpty());
}

TEST_F(RowTableOfTenBlocks, WhatOthersHideFromTheSenderThrowsNoNewShadow) {
    const PendingChange here{{{3, true, {{0.2f, 0.2f, 2.5f}, {0.8f, 0.8f, 2.6f}}}}, {}};
    EXPECT_THAT(concerned(here, 0, {}, [](const Bounds&) { return ObjectId{5}; }), IsEmpty());
    // Its own face stands before its box: what it hides is in its new shadow.
    EXPECT_THAT(concerned(here, 0, {}, [](const Bounds&) { return ObjectId{3}; }),
                ElementsAre(is(0, 0), is(1, 0)));
}

TEST_F(RowTableOfTenBlocks, ReceiversThatLieElsewhereAreEvaluatedAnew) {
    table.note(std::vector<RowTable::BlockerNote>{{0, 2, 3}});
    const PendingChange change{{{3, false, {}}}, {{2, 0b101}, {9, kAll}}};
    EXPECT_THAT(concerned(change), ElementsAre(is(2, 0b101), is(9, kAll)));
}

TEST_F(RowTableOfTenBlocks, ASenderThatMovesConcernsAllOfItsRow) {
    const PendingChange change{{{kSenderObject.value, true, kSender}}, {}};
    const std::vector<BlockMask> masks = concerned(change);
    ASSERT_EQ(masks.size(), 10u);
    for (std::uint32_t b = 0; b < 10; ++b) EXPECT_THAT(masks[b], is(b, kAll));
}

TEST(RowTable, UniteLeavesOneMaskABlockInOrder) {
    std::vector<BlockMask> masks{{5, 1}, {2, 4}, {5, 2}, {2, 4}, {0, 0}};
    unite(masks);
    EXPECT_THAT(masks, ElementsAre(is(0, 0), is(2, 4), is(5, 3)));
}

} // namespace

} // namespace penumbra
