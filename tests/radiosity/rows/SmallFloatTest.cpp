// Numbers in two bytes.
#include "radiosity/rows/SmallFloat.h"

#include <gtest/gtest.h>

#include <cmath>

namespace penumbra {

namespace {

TEST(SmallFloat, IsOffByItsLastBitAtMost) {
    for (float value = 0x1p-28f; value < 15.99f; value *= 1.0007f)
        EXPECT_LE(std::abs(SmallFloat(value) - value), value * 0x1p-12f) << value;
}

TEST(SmallFloat, KeepsWhatItHasRounded) {
    for (float value = 0x1p-28f; value < 15.99f; value *= 1.0007f) {
        const float rounded = SmallFloat(value);
        EXPECT_EQ(SmallFloat(rounded), rounded);
    }
}

TEST(SmallFloat, KeepsOneAndTheOrderOfOthers) {
    EXPECT_EQ(SmallFloat(1.0f), 1.0f);
    float before = 0;
    for (float value = 0x1p-28f; value < 15.99f; value *= 1.0002f) {
        EXPECT_GE(SmallFloat(value), before);
        before = SmallFloat(value);
    }
}

TEST(SmallFloat, WhatIsTooSmallOrTooLargeIsTheLeastOrTheLargest) {
    EXPECT_EQ(SmallFloat(0.0f), 0x1p-28f);
    EXPECT_EQ(SmallFloat(-1.0f), 0x1p-28f);
    EXPECT_EQ(SmallFloat(1e9f), SmallFloat(15.999f));
    EXPECT_NEAR(SmallFloat(1e9f), 16, 0.01);
}

} // namespace

} // namespace penumbra
