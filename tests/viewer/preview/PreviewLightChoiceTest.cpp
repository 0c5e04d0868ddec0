// Which lights are previewed, and which of them matter to a thing.
#include "viewer/preview/PreviewLightChoice.h"

#include "tests/support/LitNode.h"
#include "viewer/preview/SceneStates.h"

#include <gtest/gtest.h>

namespace penumbra {

namespace {

using Paths = std::vector<std::string>;

/// A room with a box and a light of 100 nit below its ceiling, and two panels of one mesh.
struct PanelRoom : LitRoom {
    PanelRoom(Rgb one, Rgb other) : glow(paint(Rgb(), one)) {
        const auto right = one == other ? glow : paint(Rgb(), other);
        node->add(objectOf("panels", {std::make_shared<Mesh>("mesh", twoPanels(glow, right))}));
        EXPECT_TRUE(updateUntilSettled(*node));
    }
    Paths drawable(PreviewMethod by) const {
        Paths paths;
        for (const PreviewLight& source : previewableLights(*node, by))
            paths.push_back(source.path);
        return paths;
    }
    Paths thatMatter(const std::string& thing, const PreviewLimits& limits) const {
        const PlacedScene& placed = node->placed();
        const SceneRays rays(placed);
        for (std::uint32_t o = 0; o < placed.objects.size(); ++o)
            if (placed.objects[o].path == thing)
                return lightsThatMatter(previewableLights(*node, PreviewMethod::rays), rays, {o},
                                        limits);
        return {};
    }
    std::shared_ptr<Material> glow;
};

TEST(PreviewLightChoice, AMeshThatEmitsIsPreviewedByRaysAndNotByMaps) {
    const PanelRoom room(Rgb(40), Rgb(40));
    EXPECT_EQ(room.drawable(PreviewMethod::rays), Paths({"/lamp/light", "/panels/mesh"}));
    EXPECT_EQ(room.drawable(PreviewMethod::maps), Paths({"/lamp/light"}));
}

TEST(PreviewLightChoice, OfAMeshWithTwoBrightnessesNoOneFactorTellsTheLight) {
    EXPECT_EQ(PanelRoom(Rgb(40), Rgb(20)).drawable(PreviewMethod::rays), Paths({"/lamp/light"}));
}

TEST(PreviewLightChoice, AMeshThatIsSwitchedOffIsNone) {
    const PanelRoom room(Rgb(40), Rgb(40));
    room.glow->setEmission(Rgb());
    ASSERT_TRUE(updateUntilSettled(*room.node));
    EXPECT_EQ(room.drawable(PreviewMethod::rays), Paths({"/lamp/light"}));
}

TEST(PreviewLightChoice, WhatIsInTheHandComesFirstAndThenWhatGivesTheMostLight) {
    const PanelRoom room(Rgb(40), Rgb(40));
    EXPECT_EQ(room.thatMatter("/panels", {}), Paths({"/panels/mesh", "/lamp/light"}));
    EXPECT_EQ(room.thatMatter("/box", {}), Paths({"/lamp/light", "/panels/mesh"}));
}

TEST(PreviewLightChoice, WhatGivesLessThanItsShareIsLeftOut) {
    // In far approximation 0.25 m^2 of 100 nit straight above against 2 x 0.09 m^2 of 40 nit, which
    // are seen askew: less than a quarter of all.
    const PanelRoom room(Rgb(40), Rgb(40));
    EXPECT_EQ(room.thatMatter("/box", {.least = 0.25}), Paths({"/lamp/light"}));
    EXPECT_EQ(room.thatMatter("/box", {.least = 0.01}).size(), 2u);
}

TEST(PreviewLightChoice, ALightThatIsHiddenComesLastAsTheThingMayBeMovedIntoItsLight) {
    const PanelRoom room(Rgb(40), Rgb(40));
    room.node->add(object("shade", boxData({-0.5f, -0.5f, 2.2f}, {0.5f, 0.5f, 2.3f}, false)));
    ASSERT_TRUE(updateUntilSettled(*room.node));
    EXPECT_EQ(room.thatMatter("/box", {}), Paths({"/panels/mesh", "/lamp/light"}));
    EXPECT_EQ(room.thatMatter("/box", {.least = 0.25}), Paths({"/panels/mesh"}));
    EXPECT_EQ(room.thatMatter("/box", {.hidden = false}), Paths({"/panels/mesh"}));
}

TEST(PreviewLightChoice, EachEmitterOfAMeshCountsAsALight) {
    const PanelRoom room(Rgb(40), Rgb(40));
    EXPECT_EQ(room.thatMatter("/box", {.most = 2}), Paths({"/lamp/light"}));
    EXPECT_EQ(room.thatMatter("/box", {.most = 3}).size(), 2u);
}

} // namespace

} // namespace penumbra
