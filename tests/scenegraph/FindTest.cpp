// From a path back to the nodes.
#include "scenegraph/Find.h"

#include "SceneParts.h"

#include <gtest/gtest.h>

namespace penumbra {

namespace {

TEST(Find, NodesAlongAPathAreThoseOfItsNames) {
    const auto bulb = light("Bulb");
    const auto place = make("Bulb", {bulb});
    const auto arm = make("Arm", {square("Rod"), place});
    const Group root("");
    Group top("");
    top.add(square("Arm")); // the same name, but nothing below
    top.add(arm);
    const std::vector<NodePtr> expected{arm, place, bulb};
    EXPECT_EQ(nodesAlong(top, "/Arm/Bulb/Bulb"), expected);
    EXPECT_EQ(nodesAlong(top, "/Arm").size(), 1u);
    for (const char* wrong : {"", "/", "Arm", "/Arm/", "/Arm/Rod/Bulb", "/Leg"})
        EXPECT_TRUE(nodesAlong(top, wrong).empty()) << wrong;
    EXPECT_TRUE(nodesAlong(root, "/Arm").empty());
}

} // namespace

} // namespace penumbra
