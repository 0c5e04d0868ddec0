// The one rule of exposure.
#include "io/image/Exposure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace penumbra {

namespace {

TEST(Exposure, AnEvenViewIsMiddleGreyWhateverItsLuminance) {
    for (float nits : {1e-30f, 0.001f, 50.0f, 1e6f, 1e30f})
        EXPECT_FLOAT_EQ(middleGreyOf(std::vector<float>(100, nits)).value(), nits);
}

TEST(Exposure, ASpotOfBrightLightDoesNotDarkenTheRoom) {
    std::vector<float> room(1000, 20);
    std::fill_n(room.begin(), 9, 10000.0f); // less than 1 % of the view
    EXPECT_FLOAT_EQ(middleGreyOf(room).value(), 20);
}

TEST(Exposure, ADarkRoomWithOneBrightWallIsExposedBetweenThem) {
    // By hand: of 79 cells with 1 nit and 21 with 256 one each is cut off, so the logarithms are 0
    // (78 times) and 8 (20 times). mean = 160 / 98, lean = (2 mean - 0 - 8) / 8, and
    // middle grey = 2^mean * 4^-lean = 2^(2 + mean / 2).
    std::vector<float> room(100, 1);
    std::fill_n(room.begin(), 21, 256.0f);
    EXPECT_NEAR(middleGreyOf(room).value(), std::exp2(2 + 80.0 / 98), 1e-4);
}

TEST(Exposure, OfNothingLitThereIsNone) {
    EXPECT_FALSE(middleGreyOf({}));
    const float nothing[] = {0, -1, std::numeric_limits<float>::quiet_NaN(),
                             std::numeric_limits<float>::infinity()};
    EXPECT_FALSE(middleGreyOf(nothing));
}

TEST(Exposure, ValuesAreAPhotographers) {
    // A light meter with K = 12.5 at ISO 100: EV 15, full sun, is for 4096 cd/m^2.
    EXPECT_FLOAT_EQ(middleGreyAt(15), 4096);
    for (double value : {kLowestExposureValue, 0.0, 7.25, kHighestExposureValue})
        EXPECT_NEAR(exposureValueOf(middleGreyAt(value)), value, 1e-6);
}

} // namespace

} // namespace penumbra
