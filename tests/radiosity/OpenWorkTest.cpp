// The order of open work, what is put off, and what is said about it.
#include "radiosity/OpenWork.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace penumbra {

namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// Two senders and four blocks of receivers that reflect half.
class OpenWorkOfTwoRows : public testing::Test {
protected:
    OpenWorkOfTwoRows() {
        work.setReceivers(std::vector<OpenWork::Receivers>(4, {0.5f, 0}));
        work.setPower(0, 1);
        work.setPower(1, 8);
    }
    void open(std::uint32_t row, const std::vector<OpenBlock>& blocks) { work.open(row, blocks); }
    /// Rows and blocks, ten times the row and the block.
    std::vector<int> takeAll(double enough) {
        std::vector<int> order;
        std::size_t steps = 1000;
        while (const auto block = work.take(enough, steps))
            order.push_back(int(10 * block->row + block->block));
        return order;
    }
    static OpenBlock block(std::uint32_t index, float factor, std::uint64_t anew = 0,
                           std::uint32_t since = 0) {
        return {0, index, anew, since, factor};
    }
    OpenWork work{2, 1};
};

TEST_F(OpenWorkOfTwoRows, ComesWithTheLargestBoundFirst) {
    open(0, {block(0, 0.1f), block(1, 0.4f), block(3, 0.01f)});
    open(1, {block(0, 0.1f), block(2, 0.001f)});
    EXPECT_EQ(work.count(), 5u);
    EXPECT_THAT(takeAll(0), ElementsAre(10, 1, 0, 3, 12));
    EXPECT_EQ(work.count(), 0u);
}

TEST_F(OpenWorkOfTwoRows, ComesFirstWhereTheSameBoundCostsLess) {
    open(0, {block(0, 0.1f, 0xffff), block(1, 0.1f), block(2, 0.1f, 0b1)});
    EXPECT_GT(work.cost(block(0, 0.1f, 0xffff)), work.cost(block(1, 0.1f)));
    EXPECT_THAT(takeAll(0), ElementsAre(1, 2, 0));
}

TEST_F(OpenWorkOfTwoRows, IsSummedUpOverTheSendersOfEachBlock) {
    open(0, {block(0, 0.1f), block(1, 0.4f)});
    open(1, {block(0, 0.05f)});
    EXPECT_FLOAT_EQ(float(work.light(0)), 0.1f * 1 + 0.05f * 8);
    EXPECT_FLOAT_EQ(float(work.factor(0)), 0.15f);
    EXPECT_FLOAT_EQ(float(work.bound(0)), 0.5f * 0.5f);
    EXPECT_FLOAT_EQ(float(work.bound(1)), 0.5f * 0.4f);
    EXPECT_EQ(work.bound(2), 0);
    work.setPower(1, 2); // sends less now
    EXPECT_FLOAT_EQ(float(work.light(0)), 0.1f * 1 + 0.05f * 2);
    takeAll(0);
    EXPECT_EQ(work.light(0), 0);
    EXPECT_EQ(work.factor(0), 0);
}

TEST_F(OpenWorkOfTwoRows, LightThatIsThereCountsForRowSumsThatChange) {
    work.setReceivers(std::vector<OpenWork::Receivers>(4, {0.5f, 6}));
    open(0, {block(0, 0.1f)});
    EXPECT_FLOAT_EQ(float(work.bound(0)), 0.5f * 0.1f * (1 + 6));
}

TEST_F(OpenWorkOfTwoRows, PutsOffWhatMattersTooLittleOnItsReceivers) {
    open(0, {block(0, 0.1f), block(1, 0.4f)});
    open(1, {block(0, 0.1f), block(1, 0.001f), block(2, 0.001f)});
    EXPECT_THAT(takeAll(0.06), ElementsAre(10, 1)); // leaves 0.05, 0.004 and 0.004
    EXPECT_FALSE(work.pending(0.06));
    EXPECT_TRUE(work.pending(0));
    EXPECT_EQ(work.count(), 3u);
    EXPECT_THAT(takeAll(0), ElementsAre(0, 11, 12));
    EXPECT_FALSE(work.pending(0));
}

TEST_F(OpenWorkOfTwoRows, WhatIsPutOffIsTakenAlongWhenMoreComesToIt) {
    open(0, {block(0, 0.1f, 0b01, 3)});
    EXPECT_THAT(takeAll(0.06), IsEmpty());
    open(0, {block(0, 0.2f, 0b10, 7), block(2, 0.01f)});
    EXPECT_EQ(work.count(), 2u);
    EXPECT_FLOAT_EQ(float(work.factor(0)), 0.2f); // counted once
    std::size_t steps = 100;
    const auto taken = work.take(0.06, steps);
    ASSERT_TRUE(taken);
    EXPECT_EQ(taken->block, 0u);
    EXPECT_EQ(taken->anew, 0b11u);
    EXPECT_EQ(taken->since, 3u); // all that happened since the first
    EXPECT_FLOAT_EQ(taken->factor, 0.2f);
    EXPECT_THAT(takeAll(0.06), IsEmpty());
    EXPECT_THAT(takeAll(0), ElementsAre(2));
}

TEST_F(OpenWorkOfTwoRows, TakesNoMoreStepsThanItMay) {
    open(0, {block(0, 0.1f), block(1, 0.1f), block(2, 0.1f)});
    std::size_t steps = 2;
    EXPECT_FALSE(work.take(1, steps)); // two are put off
    EXPECT_EQ(steps, 0u);
    EXPECT_TRUE(work.pending(1));
    EXPECT_THAT(takeAll(1), IsEmpty());
    EXPECT_EQ(work.count(), 3u);
}

TEST_F(OpenWorkOfTwoRows, SaysOfEachBlockWhatIsOpenAndWhatItIsWorth) {
    open(0, {block(0, 0.4f), block(1, 0.02f)});
    open(1, {block(0, 0.4f)});
    // Bounds: 0.5 (0.4 + 0.4 * 8) and 0.5 * 0.02; ranked by bound / cost, linearly.
    const std::vector<OpenWork::AtBlock> at = work.atBlocks(0.1);
    ASSERT_EQ(at.size(), 4u);
    EXPECT_EQ(at[0].rows, 2u);
    EXPECT_EQ(at[1].rows, 0u);
    EXPECT_EQ(at[1].small, 1u);
    EXPECT_EQ(at[2].rows + at[2].small, 0u);
    EXPECT_EQ(at[2].worth, 0);
    EXPECT_NEAR(at[0].worth / at[1].worth, 0.4 * 8 / 0.02, 1) << "the largest of each";
    takeAll(0.1);
    EXPECT_EQ(work.atBlocks(0.1)[0].rows, 0u);
    EXPECT_EQ(work.atBlocks(0.1)[1].small, 1u) << "put off, and still open";
    EXPECT_GT(work.atBlocks(0.1)[1].worth, 0);
}

TEST_F(OpenWorkOfTwoRows, ForgetsARowThatIsDropped) {
    open(0, {block(0, 0.1f), block(1, 0.4f)});
    open(1, {block(0, 0.1f)});
    work.drop(0);
    EXPECT_EQ(work.count(), 1u);
    EXPECT_FLOAT_EQ(float(work.light(0)), 0.8f);
    EXPECT_EQ(work.light(1), 0);
    EXPECT_THAT(takeAll(0), ElementsAre(10));
}

TEST_F(OpenWorkOfTwoRows, CanBePutInAnotherOrderAtAnyTime) {
    open(1, {block(2, 0.1f)});
    open(0, {block(0, 0.1f), block(1, 0.4f)});
    work.setOrder(std::make_shared<PlainOrder>());
    std::size_t steps = 1;
    EXPECT_EQ(work.take(0, steps)->row, 0u); // sender by sender
    open(0, {block(3, 0.1f)});
    work.setOrder(std::make_shared<BoundOrder>());
    EXPECT_THAT(takeAll(0), ElementsAre(12, 1, 3));
}

/// Blocks are places, and the last one is the one that counts.
class LastFirst : public BoundOrder {
public:
    WorkQueue::Task rank(const BlockOfWork& work) const override {
        WorkQueue::Task task = BoundOrder::rank(work);
        task.place = work.block;
        return task;
    }
    PlaceValue value(std::uint32_t place) const override {
        return {turned ? 10.0 - place : 1.0 + place, 1, true};
    }
    bool turned = false;
};

TEST_F(OpenWorkOfTwoRows, FollowsAnOrderThatChangesItsMind) {
    const auto order = std::make_shared<LastFirst>();
    work.setOrder(order);
    open(0, {block(0, 0.1f), block(1, 0.1f), block(2, 0.1f)});
    std::size_t steps = 1;
    EXPECT_EQ(work.take(0, steps)->block, 2u);
    order->turned = true;
    work.rekey();
    open(1, {block(3, 0.1f)});
    EXPECT_THAT(takeAll(0), ElementsAre(0, 1, 13));
}

} // namespace

} // namespace penumbra
