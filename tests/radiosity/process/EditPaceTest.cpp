#include "radiosity/process/EditPace.h"

#include <gtest/gtest.h>

namespace penumbra {

namespace {

TEST(EditPace, ASingleEditIsTakenInAtOnce) {
    EditPace pace;
    EXPECT_TRUE(pace.mayTake(100));
    pace.taken(100);
    pace.worked(100.01, true);
    EXPECT_TRUE(pace.mayTake(101));
}

TEST(EditPace, AnEditWaitsUntilWhatTheOneBeforeConcernsIsKnown) {
    EditPace pace;
    pace.taken(100);
    pace.worked(100.5, false);
    EXPECT_FALSE(pace.mayTake(200));
}

TEST(EditPace, HalfOfTheTimeIsWorkedHoweverFastEditsCome) {
    for (const double finding : {1e-4, 0.013, 0.2}) { // [s] an edit
        EditPace pace;
        constexpr double kPiece = 1e-3;
        double now = 0, left = 0, worked = 0;
        int edits = 0;
        while (now < 20) { // there is always another one
            if (pace.mayTake(now)) {
                pace.taken(now);
                left = finding;
                ++edits;
            }
            now += kPiece;
            if (left > 0)
                left -= kPiece;
            else
                worked += kPiece;
            pace.worked(now, left <= 0);
        }
        EXPECT_GT(worked, 0.48 * now) << finding;
        EXPECT_GT(edits, 0.4 * now / (finding + kPiece)) << finding; // and no more than half
    }
}

} // namespace

} // namespace penumbra
