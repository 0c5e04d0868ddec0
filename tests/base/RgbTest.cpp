#include "base/Rgb.h"

#include <gtest/gtest.h>

namespace penumbra {

namespace {

TEST(Rgb, LuminanceOfGreyIsTheGrey) {
    EXPECT_NEAR(luminance(Rgb(3)), 3, 1e-6);
}

TEST(Rgb, LuminanceWeighsTheChannelsAsRec709Does) {
    EXPECT_FLOAT_EQ(luminance({1, 0, 0}), 0.2126f);
    EXPECT_FLOAT_EQ(luminance({0, 1, 0}), 0.7152f);
    EXPECT_FLOAT_EQ(luminance({0, 0, 1}), 0.0722f);
}

TEST(Rgb, ArithmeticWorksChannelByChannel) {
    EXPECT_EQ(Rgb(1, 2, 3) + Rgb(4, 5, 6), Rgb(5, 7, 9));
    EXPECT_EQ(Rgb(1, 2, 3) - Rgb(4, 5, 6), Rgb(-3));
    EXPECT_EQ(Rgb(1, 2, 3) * Rgb(4, 5, 6), Rgb(4, 10, 18));
    EXPECT_EQ(2 * Rgb(1, 2, 3), Rgb(2, 4, 6));
    EXPECT_EQ(absolute(Rgb(-1, 2, -3)), Rgb(1, 2, 3));
    EXPECT_EQ(maxChannel(Rgb(-1, 2, -3)), 2);
    EXPECT_EQ(minChannel(Rgb(-1, 2, -3)), -3);
}

} // namespace

} // namespace penumbra
