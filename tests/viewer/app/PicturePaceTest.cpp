#include "viewer/app/PicturePace.h"

#include <gtest/gtest.h>

namespace penumbra {
namespace {

/// Draws all that is due at once, each picture in a tenth of a second.
void drawAll(PicturePace& pace, double now) {
    while (pace.due(now)) pace.drawn(now, 0.1);
}

/// With a window of which all is drawn.
PicturePace paceAt(double now, bool software) {
    PicturePace pace(software);
    drawAll(pace, now);
    return pace;
}

TEST(PicturePace, NothingNewIsNotDrawnAgain) {
    EXPECT_TRUE(PicturePace(true).due(0));
    EXPECT_FALSE(paceAt(10, true).due(1000));
}

TEST(PicturePace, AProcessorThatDrawsLeavesNewsMostOfItsTimeToOthers) {
    PicturePace pace = paceAt(10, true);
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

TEST(PicturePace, AGraphicsCardDrawsNewsAtOnceAndAProcessorInTheEnd) {
    for (const bool software : {false, true}) {
        PicturePace pace = paceAt(10, software);
        pace.news(1);
        EXPECT_EQ(pace.due(10.1), !software);
        EXPECT_TRUE(pace.due(11));
    }
}

TEST(PicturePace, WhatPeopleDoAndWhatComesOfItIsDrawnAtOnce) {
    PicturePace pace = paceAt(10, true);
    pace.touched(10.01);
    EXPECT_TRUE(pace.due(10.01));
    drawAll(pace, 10.01);
    pace.news();
    EXPECT_TRUE(pace.due(10.02));
}

TEST(PicturePace, WhatWasDoneFadesSmoothlyAndWhatComesByItselfAsNews) {
    PicturePace pace = paceAt(10, true);
    pace.fades(10.1);
    EXPECT_FALSE(pace.due(10.1));
    pace.touched(10.2);
    drawAll(pace, 10.2);
    pace.fades(15);
    EXPECT_TRUE(pace.due(15));
}

} // namespace
} // namespace penumbra
