// The priority of a piece of work: what the viewer gains from it for its cost.
#include "importance/Priority.h"

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
ReceiverCluster squareAt(glm::vec3 centre) {
    ReceiverCluster cluster;
    cluster.box.add(centre - glm::vec3(0.05f, 0.05f, 0));
    cluster.box.add(centre + glm::vec3(0.05f, 0.05f, 0));
    cluster.normal = {0, 0, 1};
    cluster.area = 0.01f;
    cluster.luminance = 50;
    return cluster;
}

double valueAt(glm::vec3 centre, const Attention& attention, std::optional<float> seen = {}) {
    return priorityOf(clusterPriority(squareAt(centre), attention, seen), 1, 1);
}

TEST(Priority, IsPixelsTimesVisibleStepsForWhatIsClearlySeen) {
    // 25 pixels, 10 nit of 50: 10 / 50 * S(50 nit) steps.
    const ClusterPriority cluster = clusterPriority(squareAt({0, 0, -10}), looking());
    const double steps = 10.0 / 50 * peakContrastSensitivity(50);
    EXPECT_NEAR(priorityOf(cluster, 10, 1), 25 * steps * steps / (steps + 1), 0.01 * 25 * steps);
}

TEST(Priority, RisesWithTheChangeAndFallsWithTheCost) {
    const ClusterPriority cluster = clusterPriority(squareAt({0, 0, -10}), looking());
    EXPECT_GT(priorityOf(cluster, 2, 1), priorityOf(cluster, 1, 1));
    EXPECT_NEAR(priorityOf(cluster, 1, 1), 4 * priorityOf(cluster, 1, 4), 1e-9);
    EXPECT_GT(priorityOf(cluster, 1e-6, 1), 0); // never nothing
    EXPECT_EQ(priorityOf(cluster, 0, 1), 0);
}

TEST(Priority, WhatIsTooFaintToBeSeenCountsForLessThanItsShare) {
    const ClusterPriority cluster = clusterPriority(squareAt({0, 0, -10}), looking());
    const double visible = 1 / cluster.perThreshold; // one step
    EXPECT_LT(priorityOf(cluster, 0.1 * visible, 1), 0.03 * priorityOf(cluster, visible, 1));
}

TEST(Priority, TheSameChangeIsWorthMoreInTheDark) {
    ReceiverCluster dark = squareAt({0, 0, -10});
    dark.luminance = 1;
    Attention night = looking();
    night.adaptation = 1;
    EXPECT_GT(priorityOf(clusterPriority(dark, night), 1, 1),
              3 * priorityOf(clusterPriority(squareAt({0, 0, -10}), looking()), 1, 1));
}

TEST(Priority, InThePictureComesBeforeItsMarginAndThatBeforeTheRest) {
    const double picture = valueAt({8, 0, -10}, looking());
    const double margin = valueAt({12, 0, -10}, looking());
    const double elsewhere = valueAt({30, 0, -10}, looking());
    EXPECT_GT(picture, 10 * margin);
    EXPECT_GT(margin, 10 * elsewhere);
    EXPECT_GT(elsewhere, 0);
}

TEST(Priority, WhatIsHiddenIsWorthLittleAndWhatIsHalfHiddenHalf) {
    const double open = valueAt({0, 0, -10}, looking(), 25.0f);
    EXPECT_NEAR(open, valueAt({0, 0, -10}, looking()), 1e-3 * open);
    EXPECT_NEAR(valueAt({0, 0, -10}, looking(), 12.5f), 0.5025 * open, 1e-3 * open);
    EXPECT_NEAR(valueAt({0, 0, -10}, looking(), 0.0f), 0.005 * open, 1e-3 * open);
}

TEST(Priority, IsLessInTheCornerOfTheEyeAndMoreBesideWhatIsMoved) {
    Attention attention = looking();
    EXPECT_LT(valueAt({7, 0, -7}, attention) / valueAt({0, 0, -9.9f}, attention), 0.2);
    const double alone = valueAt({0, 0, -10}, attention);
    attention.moved = Bounds{{-1, -1, -11}, {1, 1, -9}};
    EXPECT_NEAR(valueAt({0, 0, -10}, attention), 2 * alone, 1e-9);
}

TEST(Priority, EachFactorCanBeLeftOut) {
    const glm::vec3 off{30, 0, -10}, faced{0, 0, -10};
    Attention all = looking();
    all.moved = Bounds{{-1, -1, -11}, {1, 1, -9}};
    const auto without = [&](bool PriorityFactors::*factor) {
        Attention attention = all;
        attention.factors.*factor = false;
        return attention;
    };
    EXPECT_GT(valueAt(off, without(&PriorityFactors::frustum)), 100 * valueAt(off, all));
    EXPECT_GT(valueAt(off, without(&PriorityFactors::eccentricity)), 2 * valueAt(off, all));
    EXPECT_LT(valueAt(faced, without(&PriorityFactors::proximity)), 0.6 * valueAt(faced, all));
    EXPECT_GT(valueAt(faced, without(&PriorityFactors::occlusion), 0.0f),
              10 * valueAt(faced, all, 0.0f));
    EXPECT_LT(valueAt(faced, without(&PriorityFactors::size)), 0.1 * valueAt(faced, all));
    EXPECT_EQ(clusterPriority(squareAt(faced), without(&PriorityFactors::contrast)).perThreshold,
              1);
    const ClusterPriority any = clusterPriority(squareAt(faced), without(&PriorityFactors::change));
    EXPECT_EQ(priorityOf(any, 1, 1), priorityOf(any, 1e-6, 1));
}

TEST(Priority, WhatIsTurnedAwayStillCountsALittle) {
    ReceiverCluster cluster = squareAt({0, 0, -10});
    cluster.normal = {0, 0, -1};
    const double away = priorityOf(clusterPriority(cluster, looking()), 1, 1);
    EXPECT_GT(away, 0);
    EXPECT_LT(away, 0.1 * valueAt({0, 0, -10}, looking()));
}

} // namespace

} // namespace penumbra
