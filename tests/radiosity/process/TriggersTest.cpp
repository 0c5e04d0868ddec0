#include "tests/support/LitNode.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace penumbra {

namespace {

/// A session as someone would have it: some strategy in each part, switched in the middle of drags.
/// Gives the number of updates that each part has led to.
class Session {
public:
    Session() { EXPECT_TRUE(updateUntilSettled(*room.node)); }

    /// Moves the box for some frames. \return updates in these
    std::uint64_t drag(int frames) {
        const std::uint64_t before = room.node->state().updates;
        for (int i = 0; i < frames; ++i) {
            time_ += 0.1;
            room.box->setMatrix(moved(std::sin(time_), std::cos(time_), 0));
            room.node->update();
        }
        return room.node->state().updates - before;
    }
    std::uint64_t updatesBy(const std::function<void()>& act) {
        const std::uint64_t before = room.node->state().updates;
        act();
        room.node->update();
        return room.node->state().updates - before;
    }
    /// Whether the light is that of the box where it is.
    bool upToDate() {
        EXPECT_TRUE(updateUntilSettled(*room.node));
        return room.difference().empty();
    }

    LitRoom room;

private:
    double time_ = 0;
};

TEST(Triggers, UpdatesRunWhenTheStrategySaysSwitchedWhileDragging) {
    Session session;
    RadiosityNode& node = *session.room.node;
    const Node& box = *session.room.box;

    node.setTrigger(Trigger::implicit);
    EXPECT_EQ(session.updatesBy([&] { node.grab(box); }), 0u); // nothing was held back
    EXPECT_EQ(session.drag(10), 0u);
    EXPECT_FALSE(session.upToDate());

    node.setTrigger(Trigger::continuous); // in the middle of the drag
    EXPECT_EQ(session.drag(10), 10u);     // the pose held back counts no more
    EXPECT_TRUE(session.upToDate());

    node.setTrigger(Trigger::onDemand);
    EXPECT_EQ(session.drag(10), 0u);
    EXPECT_EQ(session.updatesBy([&] { node.release(box); }), 0u);
    EXPECT_FALSE(session.upToDate());
    EXPECT_EQ(session.updatesBy([&] { node.requestUpdate(); }), 1u);
    EXPECT_TRUE(session.upToDate());

    node.setTrigger(Trigger::implicit);
    node.grab(box);
    EXPECT_EQ(session.drag(10), 0u);
    EXPECT_EQ(session.updatesBy([&] { node.release(box); }), 1u);
    EXPECT_TRUE(session.upToDate());
    EXPECT_EQ(session.drag(3), 3u); // not in anyone's hand: each edit is a whole one
}

TEST(Triggers, AnObjectMayHaveOneOfItsOwn) {
    Session session;
    RadiosityNode& node = *session.room.node;
    node.setTrigger(*session.room.box, Trigger::onDemand);
    EXPECT_EQ(session.drag(5), 0u);
    EXPECT_EQ(session.updatesBy([&] { session.room.light->setLuminance(Rgb(5)); }), 1u);
    EXPECT_FALSE(session.upToDate());
    node.setTrigger(*session.room.box, std::nullopt);
    EXPECT_EQ(session.updatesBy([] {}), 1u);
    EXPECT_TRUE(session.upToDate());
}

TEST(Triggers, WhatIsHeldBackStaysSoWhenTheOtherSideIsReplaced) {
    Session session;
    RadiosityNode& node = *session.room.node;
    node.setTrigger(Trigger::onDemand);
    session.drag(1);
    node.stop(); // and another one gets the scene as it was sent
    node.start();
    EXPECT_FALSE(session.upToDate());
    node.requestUpdate();
    EXPECT_TRUE(session.upToDate());
}

} // namespace

} // namespace penumbra
