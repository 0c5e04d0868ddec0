// A thing once more.
#include "scenegraph/Copy.h"

#include "SceneParts.h"

#include <gtest/gtest.h>

#include <map>

namespace penumbra {

namespace {

TEST(Copy, IsOfTheSameShapeAndEditedByItself) {
    const auto bulb = light("Bulb");
    const auto top = square("Top");
    const auto fixture = placed("Lamp", glm::translate(glm::dmat4(1.0), {0, 0, 1}), {bulb});
    const auto shade = make<Switch>("Shade", {square("Cone")});
    shade->setVisible(false);
    const auto desk =
        objectOf("Desk", {top, fixture, shade, std::make_shared<Camera>("Eye", Lens{})});
    std::map<NodePtr, NodePtr> copies;
    const auto copy = std::dynamic_pointer_cast<Transform>(
        copyOf(desk, "Other", [&](const NodePtr& a, const NodePtr& b) { copies[a] = b; }));
    ASSERT_TRUE(copy);
    EXPECT_EQ(copy->name(), "Other");
    EXPECT_TRUE(copy->beginsObject());
    ASSERT_EQ(copy->children().size(), 3u) << "but no camera";
    EXPECT_EQ(copy->children()[0], top) << "shared";
    EXPECT_NE(copies.at(fixture), fixture);
    EXPECT_EQ(std::dynamic_pointer_cast<Transform>(copies.at(fixture))->matrix(),
              fixture->matrix());
    EXPECT_FALSE(std::dynamic_pointer_cast<Switch>(copies.at(shade))->visible());
    std::dynamic_pointer_cast<Light>(copies.at(bulb))->setLuminance(Rgb(1));
    EXPECT_EQ(bulb->luminance(), Rgb(100));
    EXPECT_EQ(copies.at(bulb)->name(), "Bulb");
}

TEST(Copy, OfACameraThereIsNone) {
    EXPECT_FALSE(copyOf(std::make_shared<Camera>("Eye", Lens{}), "Other",
                        [](const NodePtr&, const NodePtr&) { FAIL(); }));
}

} // namespace

} // namespace penumbra
