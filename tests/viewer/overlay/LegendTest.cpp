#include "viewer/overlay/Legend.h"

#include <gtest/gtest.h>

namespace penumbra {

namespace {

TEST(Legend, EachPowerOfTenIsAsFarFromTheNext) {
    const LogScale scale{0.01, 100};
    EXPECT_FLOAT_EQ(scale.at(0.01), 0);
    EXPECT_FLOAT_EQ(scale.at(0.1), 0.25f);
    EXPECT_FLOAT_EQ(scale.at(1), 0.5f);
    EXPECT_FLOAT_EQ(scale.at(100), 1);
    EXPECT_FLOAT_EQ(scale.at(0), 0);
    EXPECT_FLOAT_EQ(scale.at(1e9), 1);
}

TEST(Legend, AScaleMayRunDown) {
    const LogScale scale{100, 0.1};
    EXPECT_FLOAT_EQ(scale.at(100), 0);
    EXPECT_FLOAT_EQ(scale.at(0.1), 1);
    EXPECT_FLOAT_EQ(scale.at(0), 1);
}

TEST(Legend, TicksAreThePowersOfTenAndStandWhereTheScaleSays) {
    const std::vector<Legend::Tick> ticks = ticksOf({100, 0.1});
    ASSERT_EQ(ticks.size(), 4u);
    EXPECT_EQ(ticks.front().label, "0.1");
    EXPECT_FLOAT_EQ(ticks.front().at, 1);
    EXPECT_EQ(ticks.back().label, "100");
    EXPECT_FLOAT_EQ(ticks.back().at, 0);
    EXPECT_EQ(ticksOf({0.02, 30}).size(), 3u) << "0.1, 1, 10";
}

} // namespace

} // namespace penumbra
