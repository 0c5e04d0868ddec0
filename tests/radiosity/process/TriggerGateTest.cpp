#include "radiosity/process/TriggerGate.h"

#include <gtest/gtest.h>

namespace penumbra {

namespace {

GraphEdit pose(std::uint32_t node, double x) {
    glm::dmat4 matrix(1.0);
    matrix[3][0] = x;
    return SetMatrix{node, matrix};
}
double clusterOf(const GraphEdit& edit) {
    return std::get<SetMatrix>(edit).matrix[3][0];
}

TEST(TriggerGate, ContinuousLetsEverythingThrough) {
    TriggerGate gate(Trigger::continuous);
    gate.grab(1);
    gate.add(pose(1, 1));
    EXPECT_EQ(gate.takeDue().size(), 1u);
}

TEST(TriggerGate, ImplicitHoldsBackWhatIsInSomeonesHand) {
    TriggerGate gate(Trigger::implicit);
    gate.grab(1);
    for (int i = 0; i < 5; ++i) {
        gate.add(pose(1, i));
        gate.add(pose(2, i));
        const auto due = gate.takeDue();
        ASSERT_EQ(due.size(), 1u);
        EXPECT_EQ(std::get<SetMatrix>(due[0]).node, 2u);
    }
    EXPECT_EQ(gate.held(), 1u);
    gate.release(1);
    const auto due = gate.takeDue();
    ASSERT_EQ(due.size(), 1u);
    EXPECT_EQ(clusterOf(due[0]), 4); // of its poses the last
    EXPECT_EQ(gate.held(), 0u);
}

TEST(TriggerGate, OnDemandHoldsBackAllButWhatThereIs) {
    TriggerGate gate(Trigger::onDemand);
    gate.add(pose(1, 1));
    gate.add(SetMaterial{1, Rgb(0.5f), Rgb()});
    gate.add(SetChildren{0, {1}});
    gate.add(pose(1, 2));
    ASSERT_EQ(gate.takeDue().size(), 1u); // the children
    const auto all = gate.takeAll();
    ASSERT_EQ(all.size(), 2u);
    EXPECT_EQ(clusterOf(all[0]), 2);
    EXPECT_TRUE(gate.takeAll().empty());
}

TEST(TriggerGate, ATriggerOfItsOwnComesBeforeThatOfAll) {
    TriggerGate gate(Trigger::onDemand);
    gate.setTrigger(1, Trigger::continuous);
    gate.add(pose(1, 1));
    gate.add(pose(2, 1));
    EXPECT_EQ(gate.takeDue().size(), 1u);
    gate.setTrigger(1, std::nullopt);
    gate.add(pose(1, 2));
    EXPECT_TRUE(gate.takeDue().empty());
    gate.setTrigger(Trigger::continuous); // switched: what was held back is due
    EXPECT_EQ(gate.takeDue().size(), 2u);
}

} // namespace

} // namespace penumbra
