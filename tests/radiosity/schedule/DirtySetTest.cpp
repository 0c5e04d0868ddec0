// The order of dirty blocks, what is deferred, and the bound of that.
#include "radiosity/schedule/DirtySet.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>

namespace penumbra {

namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// Two senders and four blocks of receivers that reflect half.
class DirtySetOfTwoRows : public testing::Test {
protected:
    DirtySetOfTwoRows() {
        work.setReceivers(std::vector<DirtySet::Receivers>(4, {0.5f, 0}));
        work.setPower(0, 1);
        work.setPower(1, 8);
    }
    void mark(std::uint32_t row, const std::vector<DirtyBlock>& blocks) { work.mark(row, blocks); }
    /// Rows and blocks, ten times the row and the block.
    std::vector<int> takeAll(double enough) {
        std::vector<int> order;
        std::size_t steps = 1000;
        while (const auto block = work.take(enough, steps))
            order.push_back(int(10 * block->row + block->block));
        return order;
    }
    static DirtyBlock block(std::uint32_t index, float factor, std::uint64_t anew = 0,
                            std::uint32_t since = 0) {
        return {0, index, anew, since, factor};
    }
    DirtySet work{2, {.visit = 1, .entry = 20}};
};

TEST_F(DirtySetOfTwoRows, ComesWithTheLargestBoundFirst) {
    mark(0, {block(0, 0.1f), block(1, 0.4f), block(3, 0.01f)});
    mark(1, {block(0, 0.1f), block(2, 0.001f)});
    EXPECT_EQ(work.count(), 5u);
    EXPECT_THAT(takeAll(0), ElementsAre(10, 1, 0, 3, 12));
    EXPECT_EQ(work.count(), 0u);
}

TEST_F(DirtySetOfTwoRows, ComesFirstWhereTheSameBoundCostsLess) {
    mark(0, {block(0, 0.1f, 0xffff), block(1, 0.1f), block(2, 0.1f, 0b1)});
    EXPECT_GT(work.cost(block(0, 0.1f, 0xffff)), work.cost(block(1, 0.1f)));
    EXPECT_THAT(takeAll(0), ElementsAre(1, 2, 0));
}

TEST_F(DirtySetOfTwoRows, IsSummedUpOverTheSendersOfEachBlock) {
    mark(0, {block(0, 0.1f), block(1, 0.4f)});
    mark(1, {block(0, 0.05f)});
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

TEST_F(DirtySetOfTwoRows, LightThatIsThereCountsForRowSumsThatChange) {
    work.setReceivers(std::vector<DirtySet::Receivers>(4, {0.5f, 6}));
    mark(0, {block(0, 0.1f)});
    EXPECT_FLOAT_EQ(float(work.bound(0)), 0.5f * 0.1f * (1 + 6));
}

TEST_F(DirtySetOfTwoRows, PutsOffWhatMattersTooLittleOnItsReceivers) {
    mark(0, {block(0, 0.1f), block(1, 0.4f)});
    mark(1, {block(0, 0.1f), block(1, 0.001f), block(2, 0.001f)});
    EXPECT_THAT(takeAll(0.06), ElementsAre(10, 1)); // leaves 0.05, 0.004 and 0.004
    EXPECT_FALSE(work.pending(0.06));
    EXPECT_TRUE(work.pending(0));
    EXPECT_EQ(work.count(), 3u);
    EXPECT_THAT(takeAll(0), ElementsAre(0, 11, 12));
    EXPECT_FALSE(work.pending(0));
}

TEST_F(DirtySetOfTwoRows, WhatIsDeferredIsTakenAlongWhenMoreComesToIt) {
    mark(0, {block(0, 0.1f, 0b01, 3)});
    EXPECT_THAT(takeAll(0.06), IsEmpty());
    mark(0, {block(0, 0.2f, 0b10, 7), block(2, 0.01f)});
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

TEST_F(DirtySetOfTwoRows, TakesNoMoreStepsThanItMay) {
    mark(0, {block(0, 0.01f), block(1, 0.01f)});
    mark(1, {block(2, 0.01f)});
    std::size_t steps = 1;
    EXPECT_FALSE(work.take(1, steps)); // a row is searched
    EXPECT_EQ(steps, 0u);
    EXPECT_TRUE(work.pending(1));
    EXPECT_THAT(takeAll(1), IsEmpty());
    EXPECT_FALSE(work.pending(1));
    EXPECT_EQ(work.count(), 3u);
}

TEST_F(DirtySetOfTwoRows, SaysOfEachBlockWhatIsDirtyAndItsPriority) {
    mark(0, {block(0, 0.4f), block(1, 0.02f)});
    mark(1, {block(0, 0.4f)});
    // Bounds: 0.5 (0.4 + 0.4 * 8) and 0.5 * 0.02; ranked by bound / cost, linearly.
    const std::vector<DirtySet::AtBlock> at = work.atBlocks(0.1);
    ASSERT_EQ(at.size(), 4u);
    EXPECT_EQ(at[0].rows, 2u);
    EXPECT_EQ(at[1].rows, 0u);
    EXPECT_EQ(at[1].small, 1u);
    EXPECT_EQ(at[2].rows + at[2].small, 0u);
    EXPECT_EQ(at[2].priority, 0);
    EXPECT_NEAR(at[0].priority / at[1].priority, 0.4 * 8 / 0.02, 1) << "the largest of each";
    takeAll(0.1);
    EXPECT_EQ(work.atBlocks(0.1)[0].rows, 0u);
    EXPECT_EQ(work.atBlocks(0.1)[1].small, 1u) << "deferred, and still dirty";
    EXPECT_GT(work.atBlocks(0.1)[1].priority, 0);
}

TEST_F(DirtySetOfTwoRows, IsNarrowedToSomeReceivers) {
    mark(0, {block(0, 0.4f, 0b111), block(1, 1e-4f)});
    mark(1, {block(0, 0.01f)});
    work.narrow(0, 0, 0b110);
    work.narrow(1, 0, 0);
    work.narrow(1, 3, 0); // is not dirty
    EXPECT_EQ(work.count(), 2u);
    EXPECT_FLOAT_EQ(float(work.light(0)), 0.4f) << "of the other row there is nothing left";
    std::size_t steps = 100;
    const auto taken = work.take(0, steps);
    ASSERT_TRUE(taken);
    EXPECT_EQ(taken->anew, 0b110u);
    EXPECT_EQ(taken->receivers, 0b110u);
    EXPECT_THAT(takeAll(0), ElementsAre(1));
    mark(0, {block(0, 0.4f)});
    EXPECT_EQ(work.take(0, steps)->receivers, ~std::uint64_t(0)) << "opened again it is whole";
}

TEST_F(DirtySetOfTwoRows, SaysSinceWhenTheOldestWaits) {
    EXPECT_FALSE(work.oldest());
    mark(0, {block(0, 0.1f), block(1, 0.4f)});
    std::size_t steps = 100;
    work.take(0, steps); // the one of 0.4: the clock goes on by what it costs
    EXPECT_GT(work.taken(), 0);
    EXPECT_EQ(work.oldest().value(), 0);
    work.take(0, steps);
    EXPECT_FALSE(work.oldest());
}

TEST_F(DirtySetOfTwoRows, ForgetsARowThatIsDropped) {
    mark(0, {block(0, 0.1f), block(1, 0.4f)});
    mark(1, {block(0, 0.1f)});
    work.drop(0);
    EXPECT_EQ(work.count(), 1u);
    EXPECT_FLOAT_EQ(float(work.light(0)), 0.8f);
    EXPECT_EQ(work.light(1), 0);
    EXPECT_THAT(takeAll(0), ElementsAre(10));
}

TEST_F(DirtySetOfTwoRows, CanBePutInAnotherOrderAtAnyTime) {
    mark(1, {block(2, 0.1f)});
    mark(0, {block(0, 0.1f), block(1, 0.4f)});
    work.setPolicy(std::make_shared<PlainPolicy>());
    std::size_t steps = 100;
    EXPECT_EQ(work.take(0, steps)->row, 0u); // sender by sender
    mark(0, {block(3, 0.1f)});
    work.setPolicy(std::make_shared<BoundPolicy>());
    EXPECT_THAT(takeAll(0), ElementsAre(12, 1, 3));
}

/// Blocks are clusters, and the last one is the one that counts.
class LastFirst : public SchedulingPolicy {
public:
    WorkQueue::Task rank(const CandidateBlock& work) const override {
        WorkQueue::Task task;
        task.cluster = work.block;
        task.priority.change = float(work.bound);
        return task;
    }
    ClusterPriority value(std::uint32_t cluster) override {
        return {turned ? 10.0 - cluster : 1.0 + cluster, 1, true};
    }
    bool turned = false;
};

TEST_F(DirtySetOfTwoRows, FollowsAnOrderThatChangesItsMind) {
    const auto order = std::make_shared<LastFirst>();
    work.setPolicy(order);
    mark(0, {block(0, 0.1f), block(1, 0.1f), block(2, 0.1f)});
    std::size_t steps = 1;
    EXPECT_EQ(work.take(0, steps)->block, 2u);
    order->turned = true;
    work.rekey();
    mark(1, {block(3, 0.1f)});
    EXPECT_THAT(takeAll(0), ElementsAre(0, 1, 13));
}

/// Gains are the expected changes, of the upper half of a block twice as much from the second view.
class Looking : public BoundPolicy {
public:
    bool probes() const override { return true; }
    void gains(const CandidateBlock&, std::span<const float> change,
               std::span<float> gains) override {
        for (std::size_t r = 0; r < change.size(); ++r)
            gains[r] = change[r] * (r >= 32 && turned ? 4.0f : 1.0f);
    }
    std::uint32_t view() const override { return turned; }
    bool turned = false;
};

/// Much is to be gained at the receivers 3, 5 and 40 of a block, a little at 7, and all others are
/// what they should be.
ExpectedFactors fewDirty() {
    ExpectedFactors expected;
    expected.dirty = 1u << 3 | 1u << 5 | 1u << 7 | std::uint64_t(1) << 40;
    expected.factor[3] = expected.factor[5] = expected.factor[40] = 0.1f;
    expected.factor[7] = 1e-4f;
    for (const std::size_t r : {3u, 5u, 7u, 40u}) expected.rays[r] = 200;
    return expected;
}

TEST_F(DirtySetOfTwoRows, ComesInPartsIfTheOrderLooks) {
    work.setPolicy(std::make_shared<Looking>());
    mark(0, {block(0, 0.1f, 0b1000, 3), block(1, 0.01f)});
    std::size_t steps = 100;
    ASSERT_TRUE(work.next(0, steps)->probe);
    work.expect(0, 0, fewDirty());
    const auto first = work.take(0, steps);
    ASSERT_TRUE(first);
    EXPECT_EQ(first->block, 0u);
    EXPECT_FALSE(first->probe);
    EXPECT_EQ(first->receivers, 1u << 3 | 1u << 5 | std::uint64_t(1) << 40);
    EXPECT_EQ(first->anew, 0b1000u);
    EXPECT_EQ(work.count(), 2u) << "the rest stays dirty";
    EXPECT_GT(work.bound(0), 0);
    EXPECT_TRUE(work.next(0, steps)->probe)
        << "the other block may have a higher priority than the rest";
    work.expect(0, 1, {});
    EXPECT_EQ(work.count(), 1u) << "nothing is to be done there";
    EXPECT_EQ(work.bound(1), 0);
    const auto rest = work.take(0, steps);
    EXPECT_EQ(rest->block, 0u);
    EXPECT_EQ(rest->receivers, 1u << 7);
    EXPECT_EQ(rest->anew, 0u);
    EXPECT_EQ(rest->since, 3u);
    EXPECT_FALSE(work.take(0, steps));
    EXPECT_EQ(work.count(), 0u);
    EXPECT_EQ(work.bound(0), 0);
}

TEST_F(DirtySetOfTwoRows, PartsAreNotSoSmallThatVisitsTakeLongerThanRays) {
    work.setPolicy(std::make_shared<Looking>());
    mark(0, {block(0, 0.1f)});
    ExpectedFactors few = fewDirty();
    for (float& rays : few.rays) rays = std::min(rays, 40.0f);
    work.expect(0, 0, few);
    std::size_t steps = 100;
    EXPECT_EQ(work.take(0, steps)->receivers, few.dirty);
}

TEST_F(DirtySetOfTwoRows, PartsFollowTheViewWithoutAnotherLook) {
    const auto order = std::make_shared<Looking>();
    work.setPolicy(order);
    mark(0, {block(0, 0.1f)});
    work.expect(0, 0, fewDirty());
    order->turned = true;
    work.rekey();
    std::size_t steps = 100;
    const auto first = work.take(0, steps);
    ASSERT_TRUE(first);
    EXPECT_FALSE(first->probe);
    EXPECT_EQ(first->receivers, std::uint64_t(1) << 40);
    EXPECT_EQ(work.take(0, steps)->receivers, 1u << 3 | 1u << 5);
}

TEST_F(DirtySetOfTwoRows, WhatComesToAPartOpensAllOfTheBlockAgain) {
    work.setPolicy(std::make_shared<Looking>());
    mark(0, {block(0, 0.1f, 0, 3)});
    work.expect(0, 0, fewDirty());
    std::size_t steps = 100;
    ASSERT_EQ(std::popcount(work.take(0, steps)->receivers), 3);
    mark(0, {block(0, 0.1f, 0b1, 4)});
    const auto again = work.next(0, steps);
    EXPECT_TRUE(again->probe);
    EXPECT_EQ(~again->receivers, 0u);
    EXPECT_EQ(again->since, 3u); // of those that were left
}

TEST_F(DirtySetOfTwoRows, OverdueWorkHasItsShareOfWhatItTakes) {
    work.setPolicy(std::make_shared<Looking>());
    work.setAging(0);
    constexpr std::uint32_t kBlocks = 100;
    work.setReceivers(std::vector<DirtySet::Receivers>(kBlocks, {0.5f, 0}));
    std::vector<DirtyBlock> dull, bright;
    for (std::uint32_t b = 0; b < kBlocks; ++b) {
        dull.push_back(block(b, 1e-6f, ~std::uint64_t(0)));
        bright.push_back(block(b, 0.1f));
    }
    mark(0, dull);
    mark(1, bright);
    ExpectedFactors all; // each about as much work as an overdue one
    all.dirty = ~std::uint64_t(0);
    all.factor.fill(0.1f), all.rays.fill(20);
    double overdue = 0, taken = 0;
    std::size_t steps = 100000;
    while (taken < 20 * 1536) {
        const DirtyBlock next = work.next(0, steps).value();
        if (next.probe) {
            work.expect(next.row, next.block, all);
            continue;
        }
        work.clean(next);
        (next.overdue ? overdue : taken) += next.cost;
    }
    EXPECT_NEAR(overdue / (overdue + taken), 0.25, 0.06);
}

TEST_F(DirtySetOfTwoRows, IsDoneAsAWholeIfItIsShownAsAWhole) {
    work.setPolicy(std::make_shared<Looking>());
    work.setWhole(true);
    mark(0, {block(0, 0.1f)});
    work.expect(0, 0, fewDirty());
    std::size_t steps = 100;
    EXPECT_EQ(work.take(0, steps)->receivers, fewDirty().dirty);
    EXPECT_EQ(work.count(), 0u);
}

} // namespace

} // namespace penumbra
