// Results do not depend on how the work is cut into steps: a budget is only a matter of time.
#include "tests/support/EditedScenes.h"
#include "tests/support/LitDifference.h"

#include <gtest/gtest.h>

namespace penumbra {

namespace {

constexpr SolverOptions kTight{.residual = 1e-5};

/// Works in the smallest steps there are. \return how many
int settleInCrumbs(Solver& solver) {
    int steps = 1;
    while (!solver.step(1e-9)) ++steps;
    return steps;
}

TEST(WorkInSteps, AFirstSolutionInCrumbsIsThatInOneGo) {
    const EditableRoom room(1);
    LitScene whole(placeScene(room.scene()), EditableRoom::meshing(), kTight);
    LitScene crumbs(placeScene(room.scene()), EditableRoom::meshing(), kTight);
    whole.solver().settle();
    EXPECT_GT(settleInCrumbs(crumbs.solver()), 100);
    EXPECT_EQ(crumbs.solver().lighting().direct, whole.solver().lighting().direct);
    EXPECT_EQ(difference(crumbs, whole), "");
}

TEST(WorkInSteps, EditsInCrumbsAreThoseInOneGo) {
    for (std::uint32_t seed = 1; seed <= 4; ++seed) {
        EditableRoom room(seed);
        LitScene whole(placeScene(room.scene()), EditableRoom::meshing(), kTight);
        LitScene crumbs(placeScene(room.scene()), EditableRoom::meshing(), kTight);
        std::string said;
        for (int i = 0; i < 4; ++i) {
            said += room.edit();
            for (LitScene* lit : {&whole, &crumbs}) lit->follow(placeScene(room.scene()));
            whole.solver().settle();
            settleInCrumbs(crumbs.solver());
            ASSERT_EQ(crumbs.solver().lighting().direct, whole.solver().lighting().direct) << said;
            ASSERT_EQ(difference(crumbs, whole), "") << "seed " << seed << ": " << said;
        }
    }
}

TEST(WorkInSteps, EditsThatComeBeforeTheLastIsWorkedOffAreThoseInOneGo) {
    for (std::uint32_t seed = 1; seed <= 4; ++seed) {
        EditableRoom room(seed);
        LitScene whole(placeScene(room.scene()), EditableRoom::meshing(), kTight);
        LitScene hurried(placeScene(room.scene()), EditableRoom::meshing(), kTight);
        std::string said;
        for (int i = 0; i < 12; ++i) {
            said += room.edit();
            for (LitScene* lit : {&whole, &hurried}) lit->follow(placeScene(room.scene()));
            whole.solver().settle();
            for (int step = 0; step < 7 * i; ++step) hurried.solver().step(1e-9);
        }
        hurried.solver().settle();
        ASSERT_EQ(difference(hurried, whole), "") << "seed " << seed << ": " << said;
    }
}

TEST(WorkInSteps, APieceOfIndirectLightIsAsLargeAsItIsAskedFor) {
    // A visit counts for 48 rays. Pieces that were estimated larger than they are kept one thread
    // busy, and the others waiting.
    constexpr std::size_t kEffort = 4096; // [rays]
    double asked = 0, done = 0;
    for (std::uint32_t seed = 1; seed <= 4; ++seed) {
        EditableRoom room(seed);
        LitScene lit(placeScene(room.scene()), {.patchSize = 0.45f, .elementSize = 0.3f}, kTight);
        lit.solver().settle();
        for (int i = 0; i < 3; ++i) {
            room.edit();
            if (lit.follow(placeScene(room.scene())).rebuilt) continue;
            const WorkCount before = lit.solver().statistics().indirect;
            const auto progress = [&](const std::string& phase, double) {
                if (phase == "shadows of indirect light") asked += double(kEffort);
            };
            while (lit.solver().state() == SolutionState::working &&
                   lit.solver().work(kEffort, progress)) {
            }
            const WorkCount worked = lit.solver().statistics().indirect - before;
            done += double(worked.rays.total()) + 48 * double(worked.blocksVisited);
        }
    }
    EXPECT_GT(done, 1e5);
    EXPECT_LT(asked, 4 * done);
}

TEST(WorkInSteps, LookingAtLightThatIsHalfDoneChangesNothing) {
    EditableRoom room(2);
    LitScene whole(placeScene(room.scene()), EditableRoom::meshing(), kTight);
    LitScene watched(placeScene(room.scene()), EditableRoom::meshing(), kTight);
    bool seenEarly = false; // that something shows before all rows are up to date
    for (int i = 0; i < 3; ++i) {
        whole.solver().settle();
        const std::vector<Rgb> before = watched.solver().lighting().direct;
        while (watched.solver().work(600)) {
            watched.solver().sumUp();
            if (!seenEarly && watched.solver().direct().updates().dirty().count() > 0)
                seenEarly = watched.solver().lighting().direct != before;
        }
        ASSERT_EQ(watched.solver().lighting().direct, whole.solver().lighting().direct);
        ASSERT_EQ(difference(watched, whole), "");
        room.edit();
        for (LitScene* lit : {&whole, &watched}) lit->follow(placeScene(room.scene()));
    }
    EXPECT_TRUE(seenEarly);
}

TEST(WorkInSteps, HiddenThingsMayBeBroughtInWhateverIsUnderWay) {
    // Nothing that is drawn changes, so that what is under way goes on: fine shadows were swept
    // over elements that the sweep had no room for.
    EditableRoom room(1);
    LitScene lit(placeScene(room.scene()), EditableRoom::meshing(), kTight);
    int steps = 0, added = 0;
    bool sweeps = false;
    const auto note = [&](const std::string& phase, double share) {
        sweeps |=
            phase == "fine shadows" && share >= 0.8; // all is traced, see DetailGather::share()
    };
    while (lit.solver().state() == SolutionState::working && lit.solver().work(64, note)) {
        if (++steps % (sweeps ? 10 : 500) != 0 || added == 40) continue;
        const std::string name = "hidden" + std::to_string(added++);
        const auto choice = std::make_shared<Switch>(name);
        choice->setVisible(false);
        choice->add(object(name + "Box", boxData({1, 1, 1}, {1.5f, 1.5f, 1.5f}, false)));
        room.scene().root->add(choice);
        lit.follow(placeScene(room.scene()));
    }
    lit.solver().settle();
    EXPECT_TRUE(sweeps);
    EXPECT_EQ(added, 40);
    LitScene fresh(placeScene(room.scene()), EditableRoom::meshing(), kTight);
    fresh.solver().settle();
    EXPECT_EQ(difference(lit, fresh), "");
}

TEST(WorkInSteps, NoBudgetDoesNoWork) {
    const EditableRoom room(1);
    LitScene lit(placeScene(room.scene()), EditableRoom::meshing(), kTight);
    EXPECT_FALSE(lit.solver().step(0));
    EXPECT_EQ(lit.solver().statistics().direct.rays.total(), 0u);
}

} // namespace

} // namespace penumbra
