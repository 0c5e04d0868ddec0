// How the visible error falls as work goes on.
#include "comparison/ErrorCurve.h"

#include <gtest/gtest.h>

#include <vector>

namespace penumbra {

namespace {

using Curve = std::vector<CurvePoint>;

TEST(ErrorCurve, HoldsEachValueUntilTheNextPoint) {
    const Curve curve{{0, 8}, {10, 4}, {20, 0}};
    EXPECT_EQ(valueAt(curve, -1), 8);
    EXPECT_EQ(valueAt(curve, 0), 8);
    EXPECT_EQ(valueAt(curve, 9.9), 8);
    EXPECT_EQ(valueAt(curve, 10), 4);
    EXPECT_EQ(valueAt(curve, 99), 0);
}

TEST(ErrorCurve, AreaIsTheShareOfTheErrorThatIsThereOnAverage) {
    EXPECT_DOUBLE_EQ(normalisedArea(Curve{{0, 8}, {10, 4}, {20, 0}}, 40), 0.375); // 10 * 12 / 320
    EXPECT_DOUBLE_EQ(normalisedArea(Curve{{0, 8}}, 40), 1);                       // nothing is done
    EXPECT_DOUBLE_EQ(normalisedArea(Curve{{0, 8}, {0, 0}}, 40), 0);               // right at once
    EXPECT_DOUBLE_EQ(normalisedArea(Curve{{0, 8}, {10, 0}, {99, 5}}, 20), 0.5);   // cut off at 20
    EXPECT_EQ(normalisedArea(Curve{{0, 0}, {10, 0}}, 20), 0); // nothing was wrong
}

TEST(ErrorCurve, IsBelowAShareOnlyWhenItStaysThere) {
    const Curve curve{{0, 10}, {5, 0.5}, {6, 2}, {7, 1}, {9, 0.1}};
    EXPECT_EQ(whenBelow(curve, 0.1), 7);
    EXPECT_EQ(whenBelow(curve, 0.01), 9);
    EXPECT_EQ(whenBelow(curve, 1), 0);
    EXPECT_FALSE(whenBelow(curve, 0.001));
    EXPECT_FALSE(whenBelow({}, 0.1));
}

TEST(ErrorCurve, OfSeveralEditsIsTheirMean) {
    const Curve mean = meanOf(std::vector<Curve>{{{0, 4}, {10, 0}}, {{0, 2}, {5, 1}}});
    ASSERT_EQ(mean.size(), 3u);
    EXPECT_EQ(mean[0].y, 3);
    EXPECT_EQ(mean[1].x, 5);
    EXPECT_EQ(mean[1].y, 2.5);
    EXPECT_EQ(mean[2].y, 0.5);
}

TEST(ErrorCurve, OverTimeAndOverWorkAreOfTheSamePictures) {
    ErrorSample early{.work = 100, .seconds = 0.5, .rays = 90, .shots = 0, .error = {}};
    early.error.mean = 7;
    EXPECT_EQ(errorOverWork(std::vector{early})[0].x, 100);
    EXPECT_EQ(errorOverTime(std::vector{early})[0].x, 0.5);
    EXPECT_EQ(errorOverTime(std::vector{early})[0].y, 7);
}

} // namespace

} // namespace penumbra
