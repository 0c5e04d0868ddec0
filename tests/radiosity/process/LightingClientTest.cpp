// What the node hands to its worker stays there until the worker has it.
#include "tests/support/LitNode.h"
#include "tests/support/SteppedLink.h"

#include <gtest/gtest.h>

namespace penumbra {

namespace {

/// A room whose worker takes a turn when the test says so.
struct SteppedRoom {
    SteppedLink* link = nullptr;
    LitRoom room{[this] {
        auto stepped = std::make_unique<SteppedLink>();
        link = stepped.get();
        return stepped;
    }()};

    bool settle() {
        return updateUntil(*room.node, [this] {
            link->step();
            return room.node->state().reached(SolutionState::exact);
        });
    }
};

TEST(LightingClient, ASceneStaysUntilItIsOpenedThoughAnEarlierOneIsTaken) {
    SteppedRoom stepped;
    RadiosityNode& node = *stepped.room.node;
    ASSERT_TRUE(stepped.settle()) << describe(node);
    stepped.room.box->setBeginsObject(false); // meshed anew, so the scene goes out once more
    node.update(); // and so it does; what the worker says is of the first one
    stepped.link->step();
    node.update();
    EXPECT_EQ(node.state().restarts, 0u) << describe(node);
    ASSERT_TRUE(stepped.settle()) << describe(node);
    EXPECT_EQ(node.state().restarts, 0u) << describe(node);
    EXPECT_EQ(stepped.room.difference(), "");
}

TEST(LightingClient, OfSeveralScenesOnTheirWayEachIsThere) {
    SteppedRoom stepped;
    RadiosityNode& node = *stepped.room.node;
    node.update(); // the first
    for (const bool begins : {false, true, false}) {
        stepped.room.box->setBeginsObject(begins);
        node.update();
    }
    stepped.link->step(); // takes in all of them
    stepped.room.box->setBeginsObject(true);
    node.update();
    ASSERT_TRUE(stepped.settle()) << describe(node);
    EXPECT_EQ(node.state().restarts, 0u) << describe(node);
    EXPECT_EQ(stepped.room.difference(), "");
}

TEST(LightingClient, ASceneThatWasTakenIsNotKept) {
    SteppedRoom stepped;
    ASSERT_TRUE(stepped.settle()) << describe(*stepped.room.node);
    std::size_t kept = 0;
    for (const auto& region : stepped.link->watched.all) kept += !region.expired();
    EXPECT_EQ(kept, 2u) << "the control block and the light";
}

} // namespace

} // namespace penumbra
