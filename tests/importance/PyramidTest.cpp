// A picture as a stack of ever coarser ones.
#include "importance/Pyramid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace penumbra {

namespace {

using testing::Each;
using testing::FloatNear;

TEST(Pyramid, LeavesAnEvenPictureAsItIs) {
    const Plane even(13, 8, 5);
    EXPECT_THAT(smoothed(even).values, Each(FloatNear(5, 1e-5f)));
    EXPECT_THAT(reduced(even).values, Each(FloatNear(5, 1e-5f)));
    EXPECT_THAT(expanded(reduced(even), 13, 8).values, Each(FloatNear(5, 1e-5f)));
}

TEST(Pyramid, HalvesTheSizeRoundedUp) {
    const Plane coarse = reduced(Plane(13, 8));
    EXPECT_EQ(coarse.width, 7);
    EXPECT_EQ(coarse.height, 4);
    const Plane dot = reduced(Plane(1, 1, 3));
    EXPECT_EQ(dot.width, 1);
    EXPECT_NEAR(dot.values[0], 3, 1e-5);
}

TEST(Pyramid, SmoothsAPointIntoTheKernel) {
    Plane point(9, 9);
    point.at(4, 4) = 1;
    const Plane spread = smoothed(point);
    EXPECT_NEAR(spread.at(4, 4), 0.16, 1e-6);   // 0.4 * 0.4
    EXPECT_NEAR(spread.at(3, 4), 0.10, 1e-6);   // 0.25 * 0.4
    EXPECT_NEAR(spread.at(2, 3), 0.0125, 1e-6); // 0.05 * 0.25
    EXPECT_NEAR(std::accumulate(spread.values.begin(), spread.values.end(), 0.0), 1, 1e-6);
}

TEST(Pyramid, KeepsWhatIsCoarseThroughReductionAndExpansion) {
    Plane wave(64, 32);
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 64; ++x) wave.at(x, y) = float(std::cos(2 * M_PI * x / 32.0));
    const Plane back = expanded(reduced(wave), 64, 32);
    // The kernel's response, 0.4 + 0.5 cos(a) + 0.1 cos(2 a) at a = 2 pi / 32, twice.
    const float kept = 0.9826f * 0.9826f;
    for (int x = 8; x < 56; ++x) EXPECT_NEAR(back.at(x, 16), kept * wave.at(x, 16), 0.005) << x;
}

} // namespace

} // namespace penumbra
