// What is tried in a copy of the process.
#include "io/model/TrialRun.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <stdexcept>

namespace penumbra {

TEST(TrialRun, WhatEndsSurvivesAlsoByAnException) {
    int seen = 0;
    EXPECT_TRUE(survivesTrial([&] { seen = 1; }, 5, 20));
    EXPECT_TRUE(survivesTrial([] { throw std::runtime_error("as later"); }, 5, 20));
    EXPECT_EQ(seen, 0) << "nothing of it is seen here";
}

TEST(TrialRun, WhatCrashesOrWaitsForEverDoesNot) {
    EXPECT_FALSE(survivesTrial([] { std::raise(SIGSEGV); }, 5, 20));
    EXPECT_FALSE(survivesTrial([] { ::pause(); }, 5, 1)) << "as for a thread that is not there";
}

} // namespace penumbra
