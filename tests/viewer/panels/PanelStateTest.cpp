// What panels show.
#include "viewer/panels/PanelState.h"

#include <gtest/gtest.h>

namespace penumbra {

namespace {

TEST(History, KeepsTheLastValuesInOrder) {
    History history;
    EXPECT_EQ(history.size(), 0u);
    EXPECT_EQ(history.most(), 0);
    for (std::size_t i = 0; i < History::kSize + 10; ++i) history.add(float(i));
    EXPECT_EQ(history.size(), History::kSize);
    EXPECT_EQ(history.values()[history.oldest()], 10);
    EXPECT_EQ(history.latest(), float(History::kSize + 9));
    EXPECT_EQ(history.most(), float(History::kSize + 9));
}

TEST(PanelState, NoticesSayUntilWhenTheyStay) {
    PanelState state;
    state.time = 5;
    state.notify("saved", 2);
    ASSERT_EQ(state.notices.size(), 1u);
    EXPECT_DOUBLE_EQ(state.notices.front().until, 7);
}

} // namespace

} // namespace penumbra
