// The one parallel loop.
#include "base/Parallel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <stdexcept>
#include <vector>

namespace penumbra {

namespace {

TEST(ParallelFor, VisitsEveryIndexOnce) {
    for (std::size_t count : {0u, 1u, 7u, 64u, 1000u}) {
        std::vector<std::atomic<int>> visits(count);
        parallelFor(count, 7, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) ++visits[i];
        });
        EXPECT_TRUE(
            std::all_of(visits.begin(), visits.end(), [](const auto& v) { return v == 1; }));
    }
}

TEST(ParallelFor, CutsAlikeForAnyNumberOfThreads) {
    const auto ranges = [](unsigned threads) {
        const ThreadLimit limit(threads);
        std::mutex guard;
        std::vector<std::pair<std::size_t, std::size_t>> list;
        parallelFor(1000, 64, [&](std::size_t first, std::size_t last) {
            const std::lock_guard lock(guard);
            list.emplace_back(first, last);
        });
        std::sort(list.begin(), list.end());
        return list;
    };
    EXPECT_EQ(ranges(1), ranges(2));
}

TEST(ParallelFor, HandsExceptionsOn) {
    EXPECT_THROW(parallelFor(100, 1,
                             [](std::size_t first, std::size_t) {
                                 if (first == 50) throw std::runtime_error("out of memory");
                             }),
                 std::runtime_error);
}

TEST(ThreadLimit, OfOneRunsOneAtATime) {
    const ThreadLimit limit(1);
    std::atomic<int> running{0};
    int most = 0;
    parallelFor(200, 1, [&](std::size_t, std::size_t) {
        most = std::max(most, ++running);
        --running;
    });
    EXPECT_EQ(most, 1);
}

} // namespace

} // namespace penumbra
