// One state of a solution, in which fine shadows have their part.
#include "base/SolutionState.h"

#include "tests/support/EditedScenes.h"
#include "tests/support/LitDifference.h"
#include "tests/support/LitNode.h"
#include "tests/support/SteppedLink.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace penumbra {

namespace {

constexpr SolverOptions kCoarse{.residual = 3e-3};

/// The state as it changes from piece of work to piece of work, until there is none left.
std::vector<SolutionState> statesOf(Solver& solver) {
    std::vector<SolutionState> states{solver.state()};
    for (bool more = true; more;) {
        more = solver.work(600);
        if (solver.state() != SolutionState::working) {
            EXPECT_FALSE(solver.detail()->pending()) << "fine shadows belong to it";
            EXPECT_TRUE(solver.detail()->hits().done() || solver.state() < SolutionState::exact);
        }
        if (solver.state() == SolutionState::exact) {
            EXPECT_TRUE(solver.detail()->swept());
            EXPECT_EQ(solver.statistics().dirtyBlocks, 0u);
        }
        if (states.back() != solver.state()) states.push_back(solver.state());
    }
    return states;
}

TEST(SolutionState, IsWhatIsLeft) {
    EXPECT_EQ(stateOf({}), SolutionState::working);
    EXPECT_EQ(stateOf({.certificate = true, .fineShadows = false, .deferred = false}),
              SolutionState::working);
    EXPECT_EQ(stateOf({.certificate = false, .fineShadows = true, .deferred = false}),
              SolutionState::working);
    EXPECT_EQ(stateOf({.certificate = false, .fineShadows = false, .deferred = true}),
              SolutionState::certified);
    EXPECT_EQ(stateOf({.certificate = false, .fineShadows = false, .deferred = false}),
              SolutionState::exact);
}

TEST(SolutionState, IsNeverCertifiedWhileFineShadowsArePending) {
    bool deferred = false;
    for (std::uint32_t seed = 1; seed <= 4; ++seed) {
        EditableRoom room(seed);
        LitScene lit(placeScene(room.scene()), EditableRoom::meshing(), kCoarse);
        for (int i = 0; i < 4; ++i) {
            const std::vector<SolutionState> states = statesOf(lit.solver());
            EXPECT_TRUE(std::is_sorted(states.begin(), states.end())) << "it only goes forth";
            EXPECT_EQ(states.back(), SolutionState::exact);
            deferred |= states.size() == 3;
            room.edit();
            lit.follow(placeScene(room.scene()));
        }
    }
    EXPECT_TRUE(deferred) << "or certified was never tried";
}

TEST(SolutionState, WhatIsDrawnWhenCertifiedHasItsFineShadows) {
    EditableRoom room(2);
    LitScene lit(placeScene(room.scene()), EditableRoom::meshing(), kCoarse);
    lit.solver().settle(SolutionState::certified);
    SolverOptions bare = kCoarse;
    bare.detail = false;
    LitScene without(placeScene(room.scene()), EditableRoom::meshing(), bare);
    without.solver().settle(SolutionState::certified);
    EXPECT_NE(lit.solver().lighting().indirect, without.solver().lighting().indirect);
}

TEST(SolutionState, OfRelaxationThatIsStoppedStaysWorking) {
    const EditableRoom room(1);
    LitScene lit(placeScene(room.scene()), EditableRoom::meshing(),
                 {.residual = 1e-6, .mostShots = 40});
    EXPECT_FALSE(lit.solver().stopped());
    lit.solver().settle(); // comes back all the same
    EXPECT_EQ(lit.solver().state(), SolutionState::working);
    EXPECT_EQ(lit.solver().statistics().state, SolutionState::working);
    EXPECT_TRUE(lit.solver().stopped());
}

TEST(SolutionState, OfDirectLightAloneIsExactInTheEnd) {
    const EditableRoom room(1);
    LitScene lit(placeScene(room.scene()), EditableRoom::meshing(), {.directOnly = true});
    EXPECT_EQ(lit.solver().state(), SolutionState::working);
    lit.solver().settle();
    EXPECT_EQ(lit.solver().state(), SolutionState::exact);
}

struct SteppedRoom {
    SteppedLink* link = nullptr;
    LitRoom room;

    explicit SteppedRoom(const RadiosityOptions& options)
        : room(
              [this] {
                  auto stepped = std::make_unique<SteppedLink>();
                  link = stepped.get();
                  return stepped;
              }(),
              options) {}
    /// The states that are published until there is nothing to wait for.
    std::vector<SolutionState> states() {
        std::vector<SolutionState> seen{SolutionState::working};
        for (int i = 0; i < 20'000; ++i) {
            link->step(1e-9); // one piece of work
            room.node->update();
            const RadiosityState& now = room.node->state();
            if (seen.back() != now.solution) seen.push_back(now.solution);
            if (now.reached(SolutionState::exact)) return seen;
        }
        return {};
    }
};

TEST(SolutionState, AsItIsPublishedGoesForthUntilTheNextEdit) {
    RadiosityOptions options = LitRoom::smallRoomOptions();
    options.solving.residual = 0.05; // a tolerance that much is below
    SteppedRoom stepped(options);
    bool deferred = false;
    for (const double x : {0.0, 0.4, 0.8}) {
        stepped.room.box->setMatrix(moved(x, 0, 0));
        stepped.room.node->update();
        EXPECT_EQ(stepped.room.node->state().solution, SolutionState::working);
        const std::vector<SolutionState> states = stepped.states();
        ASSERT_FALSE(states.empty()) << describe(*stepped.room.node);
        EXPECT_TRUE(std::is_sorted(states.begin(), states.end()));
        EXPECT_EQ(states.back(), SolutionState::exact);
        deferred |= states.size() == 3;
    }
    EXPECT_TRUE(deferred);
    EXPECT_EQ(stepped.room.difference(), "");
}

TEST(SolutionState, AsItIsPublishedOfStoppedRelaxationStaysWorkingAndNobodyWaits) {
    RadiosityOptions options = LitRoom::smallRoomOptions();
    options.solving.residual = 1e-6;
    options.solving.mostShots = 40;
    SteppedRoom stepped(options);
    const std::vector<SolutionState> states = stepped.states();
    EXPECT_EQ(states, std::vector{SolutionState::working}) << describe(*stepped.room.node);
    EXPECT_TRUE(stepped.room.node->state().stopped);
    EXPECT_EQ(stepped.room.node->state().age, 0) << "all edits are in the light";
}

} // namespace

} // namespace penumbra
