// What a piece of open work is worth to the viewer.
#include "importance/WorkValue.h"

#include "importance/ContrastSensitivity.h"

#include <gtest/gtest.h>

namespace penumbra {

namespace {

/// At the origin, looking along -Z, 90 degrees wide and as high.
Attention looking() {
    Lens lens;
    lens.focalLength = 1;
    lens.horizontalAperture = lens.verticalAperture = 2;
    const Viewpoint viewpoint(makeView(lens, glm::dmat4(1.0), 1000, 1000), 1000, 1000);
    return {viewpoint, Gaze(viewpoint), 50, {}, {}};
}

/// A square of 0.1 m, turned towards +Z.
WorkPlace squareAt(glm::vec3 centre) {
    WorkPlace place;
    place.box.add(centre - glm::vec3(0.05f, 0.05f, 0));
    place.box.add(centre + glm::vec3(0.05f, 0.05f, 0));
    place.normal = {0, 0, 1};
    place.area = 0.01f;
    place.luminance = 50;
    return place;
}

double valueAt(glm::vec3 centre, const Attention& attention, std::optional<float> seen = {}) {
    return workValue(placeValue(squareAt(centre), attention, seen), 1, 1);
}

TEST(WorkValue, IsPixelsTimesVisibleStepsForWhatIsClearlySeen) {
    // 25 pixels, 10 nit of 50: 10 / 50 * S(50 nit) steps.
    const PlaceValue place = placeValue(squareAt({0, 0, -10}), looking());
    const double steps = 10.0 / 50 * peakContrastSensitivity(50);
    EXPECT_NEAR(workValue(place, 10, 1), 25 * steps * steps / (steps + 1), 0.01 * 25 * steps);
}

TEST(WorkValue, RisesWithTheChangeAndFallsWithTheCost) {
    const PlaceValue place = placeValue(squareAt({0, 0, -10}), looking());
    EXPECT_GT(workValue(place, 2, 1), workValue(place, 1, 1));
    EXPECT_NEAR(workValue(place, 1, 1), 4 * workValue(place, 1, 4), 1e-9);
    EXPECT_GT(workValue(place, 1e-6, 1), 0); // never nothing
    EXPECT_EQ(workValue(place, 0, 1), 0);
}

TEST(WorkValue, WhatIsTooFaintToBeSeenCountsForLessThanItsShare) {
    const PlaceValue place = placeValue(squareAt({0, 0, -10}), looking());
    const double visible = 1 / place.perThreshold; // one step
    EXPECT_LT(workValue(place, 0.1 * visible, 1), 0.03 * workValue(place, visible, 1));
}

TEST(WorkValue, TheSameChangeIsWorthMoreInTheDark) {
    WorkPlace dark = squareAt({0, 0, -10});
    dark.luminance = 1;
    Attention night = looking();
    night.adaptation = 1;
    EXPECT_GT(workValue(placeValue(dark, night), 1, 1),
              3 * workValue(placeValue(squareAt({0, 0, -10}), looking()), 1, 1));
}

TEST(WorkValue, InThePictureComesBeforeItsMarginAndThatBeforeTheRest) {
    const double picture = valueAt({8, 0, -10}, looking());
    const double margin = valueAt({12, 0, -10}, looking());
    const double elsewhere = valueAt({30, 0, -10}, looking());
    EXPECT_GT(picture, 10 * margin);
    EXPECT_GT(margin, 10 * elsewhere);
    EXPECT_GT(elsewhere, 0);
}

TEST(WorkValue, WhatIsHiddenIsWorthLittleAndWhatIsHalfHiddenHalf) {
    const double open = valueAt({0, 0, -10}, looking(), 25.0f);
    EXPECT_NEAR(open, valueAt({0, 0, -10}, looking()), 1e-3 * open);
    EXPECT_NEAR(valueAt({0, 0, -10}, looking(), 12.5f), 0.5025 * open, 1e-3 * open);
    EXPECT_NEAR(valueAt({0, 0, -10}, looking(), 0.0f), 0.005 * open, 1e-3 * open);
}

TEST(WorkValue, IsLessInTheCornerOfTheEyeAndMoreBesideWhatIsMoved) {
    Attention attention = looking();
    EXPECT_LT(valueAt({7, 0, -7}, attention) / valueAt({0, 0, -9.9f}, attention), 0.2);
    const double alone = valueAt({0, 0, -10}, attention);
    attention.moved = Bounds{{-1, -1, -11}, {1, 1, -9}};
    EXPECT_NEAR(valueAt({0, 0, -10}, attention), 2 * alone, 1e-9);
}

TEST(WorkValue, EachFactorCanBeLeftOut) {
    const glm::vec3 off{30, 0, -10}, faced{0, 0, -10};
    Attention all = looking();
    all.moved = Bounds{{-1, -1, -11}, {1, 1, -9}};
    const auto without = [&](bool ValueFactors::*factor) {
        Attention attention = all;
        attention.factors.*factor = false;
        return attention;
    };
    EXPECT_GT(valueAt(off, without(&ValueFactors::frustum)), 100 * valueAt(off, all));
    EXPECT_GT(valueAt(off, without(&ValueFactors::eccentricity)), 2 * valueAt(off, all));
    EXPECT_LT(valueAt(faced, without(&ValueFactors::proximity)), 0.6 * valueAt(faced, all));
    EXPECT_GT(valueAt(faced, without(&ValueFactors::occlusion), 0.0f),
              10 * valueAt(faced, all, 0.0f));
    EXPECT_LT(valueAt(faced, without(&ValueFactors::size)), 0.1 * valueAt(faced, all));
    EXPECT_EQ(placeValue(squareAt(faced), without(&ValueFactors::contrast)).perThreshold, 1);
    const PlaceValue any = placeValue(squareAt(faced), without(&ValueFactors::change));
    EXPECT_EQ(workValue(any, 1, 1), workValue(any, 1e-6, 1));
}

TEST(WorkValue, WhatIsTurnedAwayStillCountsALittle) {
    WorkPlace place = squareAt({0, 0, -10});
    place.normal = {0, 0, -1};
    const double away = workValue(placeValue(place, looking()), 1, 1);
    EXPECT_GT(away, 0);
    EXPECT_LT(away, 0.1 * valueAt({0, 0, -10}, looking()));
}

} // namespace

} // namespace penumbra
