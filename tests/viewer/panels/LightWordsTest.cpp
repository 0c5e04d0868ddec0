// What the window says of the light.
#include "viewer/panels/LightWords.h"

#include <gtest/gtest.h>

namespace penumbra {

namespace {

RadiosityState solving(SolutionState solution) {
    RadiosityState light;
    light.phase = RadiosityState::Phase::solving;
    light.solution = solution;
    light.task = "fine shadows";
    light.progress = 0.42;
    return light;
}

TEST(LightWords, SayTheStateOfTheSolutionAndNothingElseIsCalledDone) {
    EXPECT_EQ(lightWords(solving(SolutionState::working)), "computing fine shadows: 42 %");
    EXPECT_EQ(lightWords(solving(SolutionState::certified)), "light good, last details to come");
    EXPECT_EQ(lightWords(solving(SolutionState::exact)), "light complete");
    RadiosityState held = solving(SolutionState::exact);
    held.held = 2;
    EXPECT_EQ(lightWords(held), "the light waits for you: press U to update it");
    RadiosityState stopped = solving(SolutionState::working);
    stopped.stopped = true;
    EXPECT_EQ(lightWords(stopped), "stopped: the light gets no better");
}

TEST(LightWords, SayWhatTheLightMayBeWrongBy) {
    RadiosityState light;
    EXPECT_EQ(errorWords(light), "") << "nothing is lit";
    light.litIlluminance = 50;
    light.certificate = 0.25;
    EXPECT_EQ(errorWords(light), "may still be wrong by 0.5 % of the light on lit surfaces");
    light.certificate = 60;
    EXPECT_EQ(errorWords(light), "may still be wrong by as much as there is light");
}

} // namespace

} // namespace penumbra
