// Being asked to end.
#include "viewer/app/Signals.h"

#include <gtest/gtest.h>

namespace penumbra {

namespace {

// Sent to this thread alone: others of the test program were there before Signals.

TEST(Signals, AreNoticedAndDoNotKill) {
    for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
        Signals signals;
        EXPECT_FALSE(signals.endWanted());
        raise(number);
        EXPECT_TRUE(signals.endWanted());
        EXPECT_TRUE(signals.endWanted()) << "once asked, for ever";
    }
}

TEST(Signals, GiveBackHowItWas) {
    sigset_t before, after;
    pthread_sigmask(SIG_SETMASK, nullptr, &before);
    { Signals signals; }
    pthread_sigmask(SIG_SETMASK, nullptr, &after);
    EXPECT_EQ(sigismember(&before, SIGTERM), sigismember(&after, SIGTERM));
}

} // namespace

} // namespace penumbra
