#include "viewer/app/PicturePace.h"

#include <gtest/gtest.h>

namespace penumbra {
namespace {

/// Draws all that is due at once, each picture in a tenth of a second.
void drawAll(PicturePace& pace, double now) {
    while (pace.due(now)) pace.drawn(now, 0.1);
}

TEST(PicturePace, NothingNewIsNotDrawnAgain) {
    PicturePace pace(true);
    EXPECT_TRUE(pace.due(0));
    drawAll(pace, 10);
    EXPECT_FALSE(pace.due(1000));
}

TEST(PicturePace, AProcessorThatDrawsLeavesNewsMostOfItsTimeToOthers) {
    PicturePace pace(true);
    drawAll(pace, 10);
    int drawn = 0;
    for (double now = 10; now < 20; now += 0.1) {
        pace.news();
        if (!pace.due(now)) continue;
        pace.drawn(now, 0.1);
        ++drawn;
    }
    EXPECT_GT(drawn, 10); // and yet they are seen
    EXPECT_LT(drawn, 25);
}

TEST(PicturePace, AGraphicsCardDrawsNewsAtOnce) {
    PicturePace pace(false);
    drawAll(pace, 10);
    pace.news();
    EXPECT_TRUE(pace.due(10));
}

TEST(PicturePace, TheLastNewsAreDrawnInTheEnd) {
    PicturePace pace(true);
    drawAll(pace, 10);
    pace.news(1);
    EXPECT_FALSE(pace.due(10.1));
    EXPECT_TRUE(pace.due(11));
}

TEST(PicturePace, WhatPeopleDoAndWhatComesOfItIsDrawnAtOnce) {
    PicturePace pace(true);
    drawAll(pace, 10);
    pace.touched(10.01);
    EXPECT_TRUE(pace.due(10.01));
    drawAll(pace, 10.01);
    pace.news();
    EXPECT_TRUE(pace.due(10.02));
}

TEST(PicturePace, WhatWasDoneFadesSmoothlyAndWhatComesByItselfAsNews) {
    PicturePace pace(true);
    drawAll(pace, 10);
    pace.fades(10.1);
    EXPECT_FALSE(pace.due(10.1));
    pace.touched(10.2);
    drawAll(pace, 10.2);
    pace.fades(15);
    EXPECT_TRUE(pace.due(15));
}

} // namespace
} // namespace penumbra
