// What the node hands to its worker stays there until the worker has it.
#include "tests/support/LitNode.h"
#include "tests/support/SteppedLink.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

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

NodePtr shelfAt(float height) {
    return object("shelf" + std::to_string(int(100 * height)),
                  boxData({1, 1, height}, {1.5f, 1.5f, height + 0.05f}, false));
}

TEST(LightingClient, WhatComesStaysUntilItIsOpenedThoughTheSceneIsTaken) {
    SteppedRoom stepped;
    RadiosityNode& node = *stepped.room.node;
    ASSERT_TRUE(stepped.settle()) << describe(node);
    node.add(shelfAt(1));
    node.update(); // it goes out; what the worker says is of the scene
    stepped.link->step();
    node.update();
    EXPECT_EQ(node.state().restarts, 0u) << describe(node);
    ASSERT_TRUE(stepped.settle()) << describe(node);
    EXPECT_EQ(node.state().restarts, 0u) << describe(node);
    EXPECT_EQ(stepped.room.difference(), "");
}

TEST(LightingClient, WhatComesBitByBitIsThereWithTheEditsInBetween) {
    SteppedRoom stepped;
    RadiosityNode& node = *stepped.room.node;
    node.update(); // the scene
    std::vector<NodePtr> shelves;
    for (const float height : {1.0f, 1.2f, 1.4f}) {
        shelves.push_back(shelfAt(height));
        node.add(shelves.back());
        stepped.room.box->setMatrix(moved(0.1 * height, 0, 0));
        node.update();
    }
    node.remove(shelves[1]);
    stepped.room.box->setBeginsObject(false);
    node.update();
    stepped.link->step(); // takes in all of that
    stepped.room.box->setBeginsObject(true);
    node.add(shelfAt(1.6f));
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
