// Which way of preview lighting is taken.
#include "viewer/preview/Preview.h"

#include <gtest/gtest.h>

namespace penumbra {

namespace {

PreviewChoice after(bool software, int inTime, int late) {
    PreviewChoice choice(software);
    for (int i = 0; i < inTime; ++i) choice.note(0.004);
    for (int i = 0; i < late; ++i) choice.note(0.012);
    return choice;
}

TEST(PreviewChoice, RaysAreTakenUntilMostFramesAreLate) {
    EXPECT_EQ(after(false, 0, 0).method(), PreviewMethod::rays);
    EXPECT_EQ(after(false, 0, 9).method(), PreviewMethod::rays) << "too few to tell";
    EXPECT_EQ(after(false, 20, 20).method(), PreviewMethod::rays);
    EXPECT_EQ(after(false, 20, 21).method(), PreviewMethod::maps);
}

TEST(PreviewChoice, WhereTheProcessorDrawsMapsAreNeverQuicker) {
    EXPECT_EQ(after(true, 0, 100).method(), PreviewMethod::rays);
}

} // namespace

} // namespace penumbra
