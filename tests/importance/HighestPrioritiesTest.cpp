// Which pieces of work have the highest priorities.
#include "importance/HighestPriorities.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

namespace penumbra {

namespace {

using Order = std::vector<std::uint32_t>;

TEST(MostValuable, ComesFirst) {
    EXPECT_EQ(highestPriorities(std::vector<double>{1, 5, 3, 4}, 3), (Order{1, 3, 2}));
}

TEST(MostValuable, OfEqualsIsTheOneWithTheLowerIndex) {
    EXPECT_EQ(highestPriorities(std::vector<double>{2, 7, 7, 2, 7}, 4), (Order{1, 2, 4, 0}));
}

TEST(MostValuable, LeavesOutWhatIsWorthNothing) {
    EXPECT_EQ(highestPriorities(std::vector<double>{0, 1, 0}, 3), (Order{1}));
    EXPECT_TRUE(highestPriorities({}, 3).empty());
    EXPECT_TRUE(highestPriorities(std::vector<double>{1, 2}, 0).empty());
}

RC_GTEST_PROP(MostValuable, IsTheBeginningOfTheSortedList,
              (const std::vector<unsigned char>& bytes)) {
    const std::vector<double> priority(bytes.begin(), bytes.end());
    Order sorted;
    for (std::uint32_t i = 0; i < priority.size(); ++i)
        if (priority[i] > 0) sorted.push_back(i);
    std::stable_sort(sorted.begin(), sorted.end(),
                     [&](auto a, auto b) { return priority[a] > priority[b]; });
    sorted.resize(std::min<std::size_t>(sorted.size(), 5));
    RC_ASSERT(highestPriorities(priority, 5) == sorted);
}

} // namespace

} // namespace penumbra
