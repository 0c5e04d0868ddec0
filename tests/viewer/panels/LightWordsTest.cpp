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
    EXPECT_EQ(lightWords(solving(SolutionState::working)), "fine shadows 42 %");
    EXPECT_EQ(lightWords(solving(SolutionState::certified)), "light certified");
    EXPECT_EQ(lightWords(solving(SolutionState::exact)), "light exact");
    RadiosityState held = solving(SolutionState::exact);
    held.held = 2;
    EXPECT_EQ(lightWords(held), "waiting for an update (U)");
    RadiosityState stopped = solving(SolutionState::working);
    stopped.stopped = true;
    EXPECT_EQ(lightWords(stopped), "light stopped at its limit of work");
}

} // namespace

} // namespace penumbra
