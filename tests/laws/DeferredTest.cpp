// What can't matter for the certificate is deferred: the light is then as near to the settled light
// as the certificate says, and settles all the same.
#include "tests/support/EditedScenes.h"
#include "tests/support/LitDifference.h"

#include <gtest/gtest.h>

namespace penumbra {

namespace {

constexpr SolverOptions kCoarse{.residual = 3e-3};

double largestDifference(const std::vector<Rgb>& a, const std::vector<Rgb>& b) {
    double most = 0;
    for (std::size_t p = 0; p < a.size(); ++p)
        most = std::max<double>(most, maxChannel(absolute(a[p] - b[p])));
    return most;
}

TEST(Deferred, TheCertificateCoversWhatIsStillOpen) {
    std::uint64_t open = 0;
    for (std::uint32_t seed = 1; seed <= 12; ++seed) {
        EditableRoom room(seed);
        LitScene lit(placeScene(room.scene()), EditableRoom::meshing(), kCoarse);
        lit.solver().settle();
        std::string said;
        for (int i = 0; i < 5; ++i) {
            said += room.edit();
            lit.follow(placeScene(room.scene()));
            lit.solver().settle(SolutionState::certified);
            const SolveStatistics then = lit.solver().statistics();
            const std::vector<Rgb> sent = lit.solver().radiosity();
            ASSERT_GE(lit.solver().state(), SolutionState::certified);
            ASSERT_LE(then.certificate, kCoarse.residual * then.brightest) << said;
            open += then.dirtyBlocks;
            lit.solver().settle();
            const SolveStatistics now = lit.solver().statistics();
            ASSERT_GE(lit.solver().state(), SolutionState::certified);
            EXPECT_EQ(now.dirtyBlocks, 0u);
            EXPECT_EQ(now.dirtyBound, 0);
            EXPECT_LE(largestDifference(sent, lit.solver().radiosity()),
                      then.certificate + now.certificate)
                << "seed " << seed << ": " << said;
        }
    }
    EXPECT_GT(open, 1000u);
}

TEST(Deferred, EditsThatComeWhileWorkIsDeferredSettleAsInOneGo) {
    for (std::uint32_t seed = 1; seed <= 6; ++seed) {
        EditableRoom room(seed);
        LitScene hurried(placeScene(room.scene()), EditableRoom::meshing(), kCoarse);
        std::string said;
        for (int i = 0; i < 12; ++i) {
            said += room.edit();
            hurried.follow(placeScene(room.scene()));
            hurried.solver().settle(SolutionState::certified); // and never more
        }
        hurried.solver().settle();
        LitScene scratch(placeScene(room.scene()), sizesOf(hurried.patches()), kCoarse);
        scratch.solver().settle();
        ASSERT_EQ(difference(hurried, scratch), "") << "seed " << seed << ": " << said;
    }
}

TEST(Deferred, AFirstSolutionConvergesBeforeItSettles) {
    const EditableRoom room(3);
    LitScene lit(placeScene(room.scene()), EditableRoom::meshing(), kCoarse);
    EXPECT_EQ(lit.solver().state(), SolutionState::working);
    lit.solver().settle(SolutionState::certified);
    EXPECT_GE(lit.solver().state(), SolutionState::certified);
    const std::vector<Rgb> sent = lit.solver().radiosity();
    const double allowed = 2 * lit.solver().statistics().certificate;
    lit.solver().settle();
    EXPECT_LE(largestDifference(sent, lit.solver().radiosity()), allowed);
}

} // namespace

} // namespace penumbra
