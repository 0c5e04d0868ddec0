// What of a view counts for exposure.
#include "base/ViewMeter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace penumbra {

namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(ViewMeter, LightsInViewAndBackgroundDoNotCount) {
    const std::vector<MeterCell> cells{
        {.reflected = 60, .reflecting = 3, .emitted = 5000, .emitting = 1},
        {.emitted = 80000, .emitting = 16},
        {},
        {.reflected = 0, .reflecting = 16},
    };
    EXPECT_THAT(meteredLuminances(cells), ElementsAre(20, 0));
}

TEST(ViewMeter, AViewOfLightsAloneIsMeteredByThem) {
    const std::vector<MeterCell> cells{
        {.emitted = 80000, .emitting = 16}, {.reflecting = 16}, {.emitted = 100, .emitting = 2}};
    EXPECT_THAT(meteredLuminances(cells), ElementsAre(5000, 50));
}

TEST(ViewMeter, WhereNothingIsThereIsNothingToMeter) {
    EXPECT_THAT(meteredLuminances(std::vector<MeterCell>(4)), IsEmpty());
}

} // namespace

} // namespace penumbra
