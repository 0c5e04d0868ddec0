// Exposure that adapts.
#include "io/image/AutoExposure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace penumbra {

namespace {

std::vector<float> evenly(float nits) {
    return std::vector<float>(100, nits);
}

TEST(AutoExposure, TakesTheFirstMeasurementAtOnceAndAsAPictureWouldBeExposed) {
    std::vector<float> luminances;
    for (int i = 1; i <= 1000; ++i) luminances.push_back(float(i) * 0.3f);
    AutoExposure exposure;
    EXPECT_FALSE(exposure.measured());
    EXPECT_FLOAT_EQ(exposure.middleGrey(), kUnmeasuredGrey);
    exposure.measure(luminances);
    EXPECT_FLOAT_EQ(exposure.middleGrey(), middleGreyOf(luminances).value());
    EXPECT_TRUE(exposure.settled());
}

TEST(AutoExposure, DoesNotDependOnTheFrameRate) {
    AutoExposure fast, slow;
    for (AutoExposure* exposure : {&fast, &slow}) {
        exposure->measure(evenly(10));
        exposure->measure(evenly(500));
    }
    for (int i = 0; i < 120; ++i) fast.advance(0.5 / 120);
    for (int i = 0; i < 5; ++i) slow.advance(0.1);
    EXPECT_NEAR(fast.middleGrey() / slow.middleGrey(), 1, 1e-6);
    EXPECT_GT(fast.middleGrey(), 10);
    EXPECT_LT(fast.middleGrey(), 500);
}

TEST(AutoExposure, IsFasterTowardsTheBrightAndComesToRest) {
    const auto stopsGone = [](float from, float to) {
        AutoExposure exposure;
        exposure.measure(evenly(from));
        exposure.measure(evenly(to));
        exposure.advance(0.2);
        return std::abs(std::log2(exposure.middleGrey() / from));
    };
    EXPECT_GT(stopsGone(10, 80), 1.4 * stopsGone(80, 10));
    AutoExposure exposure;
    exposure.measure(evenly(10));
    exposure.measure(evenly(80));
    EXPECT_FALSE(exposure.settled());
    exposure.advance(5);
    EXPECT_TRUE(exposure.settled());
    EXPECT_NEAR(exposure.middleGrey(), 80, 0.01);
}

TEST(AutoExposure, StaysWhileItIsHeldOrFixedOrSeesNothing) {
    AutoExposure exposure;
    exposure.measure(evenly(10));
    exposure.measure(evenly(0)); // black: no news
    exposure.advance(10);
    EXPECT_NEAR(exposure.middleGrey(), 10, 1e-4);
    exposure.measure(evenly(80));
    exposure.advance(10, true);
    EXPECT_NEAR(exposure.middleGrey(), 10, 1e-4);
    exposure.fix(25.0f);
    exposure.advance(10);
    EXPECT_FLOAT_EQ(exposure.middleGrey(), 25);
    exposure.fix(std::nullopt); // goes on from where it is
    EXPECT_NEAR(exposure.middleGrey(), 25, 1e-4);
    exposure.advance(10);
    EXPECT_NEAR(exposure.middleGrey(), 80, 0.01);
}

TEST(AutoExposure, AStopOfCompensationDoublesThePicture) {
    AutoExposure exposure;
    exposure.measure(evenly(64));
    exposure.setCompensation(1);
    EXPECT_FLOAT_EQ(exposure.middleGrey(), 32);
}

} // namespace

} // namespace penumbra
