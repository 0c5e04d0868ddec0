// How near something is to the object being moved.
#include "importance/Proximity.h"

#include <gtest/gtest.h>

#include <cmath>

namespace penumbra {

namespace {

TEST(DistanceBetween, BoxesIsThatOfTheirNearestPoints) {
    const Bounds unit{{0, 0, 0}, {1, 1, 1}};
    EXPECT_EQ(distanceBetween(unit, {{0.5f, 0.5f, 0.5f}, {2, 2, 2}}), 0);
    EXPECT_EQ(distanceBetween(unit, {{3, 0, 0}, {4, 1, 1}}), 2);         // face to face
    EXPECT_EQ(distanceBetween({{4, 5, 0}, {5, 6, 1}}, unit), 5);         // edge to edge: 3, 4, 5
    EXPECT_NEAR(distanceBetween(unit, {{2, 3, 3}, {4, 4, 4}}), 3, 1e-6); // corner: 1, 2, 2
}

TEST(ProximityWeight, IsTwiceBesideTheObjectAndOnceFarAway) {
    EXPECT_EQ(proximityWeight(0), 2);
    EXPECT_NEAR(proximityWeight(1), 1 + std::exp(-1.0), 1e-12);
    EXPECT_NEAR(proximityWeight(30), 1, 1e-9);
}

} // namespace

} // namespace penumbra
