// From a path back to the nodes.
#include "scenegraph/Find.h"

#include "SceneParts.h"

#include <gtest/gtest.h>

namespace penumbra {

namespace {

TEST(Find, NodesAtAPathAreThoseWhosePathItIs) {
    const auto bulb = light("Bulb");
    const auto place = make("Bulb", {bulb});
    const auto arm = make("Arm", {square("Rod"), place});
    const auto other = square("Arm"); // the same name, but nothing below
    const Group root("");
    Group top("");
    top.add(other);
    top.add(arm);
    EXPECT_EQ(nodesAt(top, "/Arm/Bulb/Bulb"), std::vector<NodePtr>{bulb});
    EXPECT_EQ(nodesAt(top, "/Arm"), (std::vector<NodePtr>{other, arm}));
    for (const char* wrong : {"", "/", "Arm", "/Arm/", "/Ar", "/Arms", "/Arm/Rod/Bulb", "/Leg"})
        EXPECT_TRUE(nodesAt(top, wrong).empty()) << wrong;
    EXPECT_TRUE(nodesAt(root, "/Arm").empty());
}

TEST(Find, ANodeWithoutANameSharesThePathOfTheOneAbove) {
    const auto bulb = light(""), lens = light("Lens");
    const auto place = make<Transform>("", {bulb, lens});
    const auto fixture = make("Fixture", {place});
    Group top("");
    top.add(fixture);
    EXPECT_EQ(nodesAt(top, "/Fixture"), (std::vector<NodePtr>{fixture, place, bulb}));
    EXPECT_EQ(findAt<Light>(top, "/Fixture"), bulb);
    EXPECT_EQ(findAt<Light>(top, "/Fixture/Lens"), lens);
    EXPECT_EQ(findAt<Transform>(top, "/Fixture"), place);
    EXPECT_EQ(findAt<Transform>(top, "/Fixture/Lens"), nullptr);
}

TEST(Find, ThePlaceOfANodeIsAmongTheChildrenOfItsParent) {
    const auto bulb = light("Bulb");
    const auto left = make("Left", {square("Rod"), bulb}), right = make("Right", {bulb});
    const auto top = make("", {left, right});
    const auto place = placeOf(top, "/Right/Bulb", *bulb);
    ASSERT_TRUE(place);
    EXPECT_EQ(place->parent, right) << "of its two parents";
    EXPECT_EQ(place->index, 0u);
    EXPECT_EQ(placeOf(top, "/Left/Bulb", *bulb)->index, 1u);
    EXPECT_EQ(placeOf(top, "/Left", *left)->parent, top);
    EXPECT_FALSE(placeOf(top, "/Left", *right));
    EXPECT_FALSE(placeOf(top, "/", *left));
    top->remove(left);
    top->insert(1, left);
    top->insert(9, bulb);
    EXPECT_EQ(top->children(), (std::vector<NodePtr>{right, left, bulb}));
}

} // namespace

} // namespace penumbra
