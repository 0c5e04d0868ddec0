// Tasks by priority, in a new order at once when the viewer moves.
#include "importance/WorkQueue.h"

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <map>
#include <vector>

namespace penumbra {

namespace {

using testing::ElementsAre;
using Ids = std::vector<std::uint64_t>;

ClusterPriority weight(double pixels) {
    return {pixels, 1, false};
}

Ids takeAll(WorkQueue& queue, double now = 0) {
    Ids ids;
    while (const auto task = queue.take(now)) ids.push_back(task->id);
    return ids;
}

TEST(WorkQueue, TakesTheMostValuableFirst) {
    WorkQueue queue;
    queue.add({.cluster = 0, .id = 10, .priority = {.change = 1}});
    queue.add({.cluster = 1, .id = 11, .priority = {.change = 3}});
    queue.add({.cluster = 0, .id = 12, .priority = {.change = 2}});
    queue.add({.cluster = 1, .id = 13, .priority = {.change = 2, .cost = 4}});
    queue.rekey([](std::uint32_t) { return weight(1); });
    EXPECT_THAT(takeAll(queue), ElementsAre(11, 12, 10, 13));
}

TEST(WorkQueue, OfEqualsTakesTheOldest) {
    WorkQueue queue;
    for (std::uint64_t id = 0; id < 6; ++id)
        queue.add({.cluster = std::uint32_t(5 - id) % 3, .id = id, .priority = {.change = 1}});
    queue.rekey([](std::uint32_t) { return weight(1); });
    EXPECT_THAT(takeAll(queue), ElementsAre(0, 1, 2, 3, 4, 5));
}

TEST(WorkQueue, FollowsTheViewerAtOnce) {
    WorkQueue queue;
    for (std::uint32_t cluster = 0; cluster < 4; ++cluster)
        for (std::uint64_t i = 0; i < 2; ++i)
            queue.add({.cluster = cluster, .id = 10 * cluster + i, .priority = {.change = 1}});
    queue.rekey([](std::uint32_t cluster) { return weight(cluster); });
    EXPECT_EQ(queue.take(0)->id, 30u);
    queue.rekey([](std::uint32_t cluster) { return weight(4.0 - cluster); });
    EXPECT_THAT(takeAll(queue), ElementsAre(0, 1, 10, 11, 20, 21, 31));
}

TEST(WorkQueue, OnePlaceCanBeKeyedByItself) {
    WorkQueue queue;
    for (std::uint32_t cluster = 0; cluster < 3; ++cluster)
        queue.add({.cluster = cluster, .id = cluster, .priority = {.change = 1}});
    queue.rekey([](std::uint32_t cluster) { return weight(3.0 - cluster); });
    queue.rekey(0, weight(0.5));
    EXPECT_THAT(takeAll(queue), ElementsAre(1, 2, 0));
}

TEST(WorkQueue, WorkThatComesAfterTheViewerMovedIsWorthWhatItIsNow) {
    WorkQueue queue;
    queue.add({.cluster = 0, .id = 0, .priority = {.change = 1}});
    queue.add({.cluster = 1, .id = 1, .priority = {.change = 1}});
    queue.rekey([](std::uint32_t cluster) { return weight(cluster == 1 ? 9 : 1); });
    EXPECT_EQ(queue.take(0)->id, 1u); // cluster 1 has no task now
    queue.rekey([](std::uint32_t cluster) { return weight(cluster == 1 ? 0.5 : 1); });
    queue.add({.cluster = 1, .id = 2, .priority = {.change = 1}});
    queue.add({.cluster = 7, .id = 3, .priority = {.change = 1.5}});
    EXPECT_THAT(takeAll(queue), ElementsAre(3, 0, 2));
}

TEST(WorkQueue, WorkAddedLaterTakesItsRank) {
    WorkQueue queue;
    queue.add({.cluster = 0, .id = 0, .priority = {.change = 1}});
    queue.add({.cluster = 0, .id = 1, .priority = {.change = 3}});
    queue.rekey([](std::uint32_t) { return weight(1); });
    EXPECT_EQ(queue.take(0)->id, 1u);
    queue.add({.cluster = 0, .id = 2, .priority = {.change = 2}});
    EXPECT_THAT(takeAll(queue), ElementsAre(2, 0));
}

TEST(WorkQueue, RanksATaskAnewWithoutMakingItYounger) {
    WorkQueue queue;
    const auto first = queue.add({.cluster = 0, .id = 0, .priority = {.change = 1}, .since = 1});
    queue.add({.cluster = 1, .id = 1, .priority = {.change = 2}, .since = 2});
    queue.rekey([](std::uint32_t) { return weight(1); });
    queue.rank(first, {.change = 3});
    EXPECT_EQ(queue.oldest(9), 1);
    EXPECT_THAT(takeAll(queue), ElementsAre(0, 1));
}

TEST(WorkQueue, WhatIsChosenToBeLookedAtComesBackWhereItBelongs) {
    WorkQueue queue;
    for (std::uint64_t id = 0; id < 3; ++id)
        queue.add({.cluster = 0, .id = id, .priority = {.change = float(9 - id)}});
    queue.rekey([](std::uint32_t) { return weight(1); });
    const auto looked = queue.choose(0);
    EXPECT_EQ(looked->task.id, 0u);
    EXPECT_EQ(queue.choose(0)->task.id, 1u); // not the same again
    EXPECT_EQ(queue.size(), 3u);
    queue.rank(looked->handle, {.change = 1, .share = 0.5f});
    EXPECT_THAT(takeAll(queue), ElementsAre(2, 0));
}

TEST(WorkQueue, CountsChangesByTheShareOfThePlaceThatChanges) {
    WorkQueue queue;
    queue.add({.cluster = 0, .id = 0, .priority = {.change = 4, .share = 0.25f}});
    queue.add({.cluster = 0, .id = 1, .priority = {.change = 4, .share = 0.5f}});
    queue.add({.cluster = 1, .id = 2, .priority = {.change = 4, .share = 0.125f}});
    queue.rekey([](std::uint32_t) { return weight(1); });
    EXPECT_THAT(takeAll(queue), ElementsAre(1, 0, 2));
}

/// What an overdue test needs: much work of higher priority coming all the time.
struct Dragging {
    WorkQueue queue{{.aging = 100, .reserve = 0.25}};
    double done = 0, now = 0; ///< cost

    void keepBusy(std::uint64_t id) {
        queue.add({.cluster = 1, .id = id, .priority = {.change = 10}, .since = now});
        queue.rekey(1, weight(100));
    }
};

TEST(WorkQueue, NothingStarvesWhileNewWorkIsWorthMore) {
    Dragging drag;
    constexpr double kHidden = 40; // tasks of cost 1 that nobody sees
    for (std::uint64_t id = 0; id < kHidden; ++id)
        drag.queue.add({.cluster = 0, .id = id, .priority = {.change = 1}, .since = 0});
    drag.queue.rekey([](std::uint32_t) { return weight(1e-3); });
    double lastHidden = 0;
    for (std::uint64_t id = 1000; drag.now < 1000; ++id) {
        drag.keepBusy(id);
        const auto task = drag.queue.take(drag.now);
        drag.now += task->priority.cost;
        if (task->id < kHidden) {
            EXPECT_GE(drag.now, 100); // not before their time
            lastHidden = drag.now;
        }
    }
    // Work of cost 40 ahead of the last one: aging + 40 / 0.25, and one task.
    EXPECT_LE(lastHidden, 100 + 40 / 0.25 + 1);
    EXPECT_GE(lastHidden, 100 + 40 / 0.25 - 4); // and no more than its share is spent on it
}

TEST(WorkQueue, WorkThatIsRankedAgainAndAgainIsDoneInTime) {
    // Dragging without end: hidden work is ranked again each time, and keeps its age.
    Dragging drag;
    const auto hidden =
        drag.queue.add({.cluster = 0, .id = 7, .priority = {.change = 1}, .since = drag.now});
    drag.queue.rekey([](std::uint32_t) { return weight(1e-3); });
    for (std::uint64_t id = 1000; drag.now < 1000; ++id) {
        drag.keepBusy(id);
        const auto task = drag.queue.take(drag.now);
        drag.now += task->priority.cost;
        if (task->id == 7) break;
        drag.queue.rank(hidden, {.change = float(id % 3)});
    }
    EXPECT_GE(drag.now, 100);
    EXPECT_LE(drag.now, 100 + 1 / 0.25 + 2);
}

TEST(WorkQueue, AgingChangesNoPriorityBeforeItSetsIn) {
    WorkQueue unaged, fair{{.aging = 50, .reserve = 0.5}};
    for (WorkQueue* queue : {&unaged, &fair}) {
        for (std::uint64_t id = 0; id < 30; ++id)
            queue->add({.cluster = std::uint32_t(id % 7),
                        .id = id,
                        .priority = {.change = float(id * 13 % 11)}});
        queue->rekey([](std::uint32_t cluster) { return weight(cluster + 1); });
    }
    EXPECT_EQ(takeAll(unaged, 49), takeAll(fair, 49));
}

TEST(WorkQueue, KnowsItsOldestWork) {
    WorkQueue queue;
    EXPECT_EQ(queue.oldest(7), 7);
    queue.add({.cluster = 0, .id = 0, .priority = {.change = 9}, .since = 1});
    queue.add({.cluster = 0, .id = 1, .priority = {.change = 1}, .since = 3});
    queue.rekey([](std::uint32_t) { return weight(1); });
    EXPECT_EQ(queue.oldest(7), 1);
    queue.take(7);
    EXPECT_EQ(queue.oldest(7), 3);
    EXPECT_EQ(queue.size(), 1u);
}

TEST(WorkQueue, WhatGainsSoMuchIsWorthThatPerCost) {
    WorkQueue queue;
    queue.rekey([](std::uint32_t cluster) { return ClusterPriority{2.0 + cluster, 0.3, false}; });
    const auto add = [&](double gain, double cost) {
        return queue.add({.cluster = 1, .id = 0, .priority = queue.priorityFor(1, gain, cost)});
    };
    EXPECT_NEAR(queue.value(add(6, 4)), 1.5, 1e-5);
    EXPECT_NEAR(queue.value(add(1e-3, 4)), 2.5e-4, 1e-9);
    EXPECT_GT(queue.value(add(0, 4)), 0) << "no priority is ever 0";
    const WorkQueue::Handle seen = add(6, 4);
    queue.rekey([](std::uint32_t) { return ClusterPriority{30, 0.3, false}; });
    EXPECT_NEAR(queue.value(seen), 15, 1e-4) << "ten times the pixels";
}

TEST(WorkQueue, WhatIsDoneInPartStaysOpenWithItsAge) {
    WorkQueue queue({.aging = 100, .reserve = 0.25});
    queue.rekey([](std::uint32_t) { return weight(1); });
    queue.add({.cluster = 0, .id = 7, .priority = {.change = 9}, .since = 1});
    queue.add({.cluster = 0, .id = 8, .priority = {.change = 5}, .since = 3});
    queue.finishPart(*queue.choose(4), 1, {.change = 1});
    EXPECT_EQ(queue.size(), 2u);
    EXPECT_EQ(queue.oldest(4), 1);
    EXPECT_EQ(queue.take(4)->id, 8u);
    EXPECT_EQ(queue.take(4)->id, 7u);
}

/// The order by clusters is that of the tasks' own priorities, however they come and are keyed.
RC_GTEST_PROP(WorkQueue, TakesWhatASortedListWouldHaveFirst, ()) {
    struct Open {
        WorkQueue::Task task;
        std::uint64_t age;
    };
    WorkQueue queue;
    std::vector<Open> list;
    std::map<std::uint32_t, ClusterPriority> values;
    const auto draw = [](int most) { return *rc::gen::inRange(0, most); };
    std::uint64_t age = 0;
    const int steps = 20 + draw(150);
    for (int step = 0; step < steps; ++step) {
        const int what = draw(8);
        if (what < 4) {
            const WorkQueue::Task task{
                .cluster = std::uint32_t(draw(6)),
                .id = age,
                .priority = {.change = float(draw(5)), .cost = float(1 + draw(3))}};
            queue.add(task);
            list.push_back({task, age++});
        } else if (what == 4) {
            for (std::uint32_t p = 0; p < 6; ++p) values[p] = weight(draw(4));
            queue.rekey([now = values](std::uint32_t cluster) { return now.at(cluster); });
        } else if (what == 5) {
            const auto cluster = std::uint32_t(draw(6));
            values[cluster] = weight(draw(4));
            queue.rekey(cluster, values[cluster]);
        } else {
            const auto task = queue.take(0);
            RC_ASSERT(task.has_value() == !list.empty());
            if (!task) continue;
            const auto better = [&](const Open& a, const Open& b) {
                const double va = priorityOf(values[a.task.cluster], a.task.priority.change,
                                             a.task.priority.cost);
                const double vb = priorityOf(values[b.task.cluster], b.task.priority.change,
                                             b.task.priority.cost);
                return va != vb ? va > vb : a.age < b.age;
            };
            const auto best = std::min_element(list.begin(), list.end(), better);
            RC_ASSERT(best->task.id == task->id);
            list.erase(best);
        }
        RC_ASSERT(queue.size() == list.size());
    }
}

} // namespace

} // namespace penumbra
