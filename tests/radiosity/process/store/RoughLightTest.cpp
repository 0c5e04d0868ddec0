#include "radiosity/process/store/RoughLight.h"

#include "tests/support/LitNode.h"
#include "tests/support/Scenes.h"
#include "tests/support/SteppedLink.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace penumbra {

namespace {

const MeshingOptions kCoarse{.patchSize = 0.25f, .elementSize = 0.125f};

/// A room with a box in it that throws a shadow.
Scene shadowedRoom() {
    return sceneOf({object("room", boxData({-1, -1, -1}, {1, 1, 1}, true)),
                    object("box", boxData({-0.4f, -0.3f, -1}, {0.2f, 0.4f, -0.4f}, false)),
                    ceilingLight({0, 0, 0.99f}, 0.3f, 0.3f)});
}

TEST(RoughLight, IsExactWhereNothingOrAllIsInTheWayAndCloseInBetween) {
    const Solution solution(shadowedRoom(), kCoarse, {.directOnly = true});
    const RoughLight rough = roughLight(solution.patches(), solution.rays);
    ASSERT_EQ(rough.direct.size(), solution.lighting.direct.size());
    double sum = 0, apart = 0;
    std::size_t exact = 0, count = 0;
    for (std::size_t v = 0; v < rough.direct.size(); ++v) {
        const double is = double(rough.direct[v].g), was = double(solution.lighting.direct[v].g);
        sum += was;
        apart += std::abs(is - was);
        exact += std::abs(is - was) <= 1e-5 * was;
        count += was > 0;
    }
    EXPECT_GT(exact, count / 2);
    EXPECT_LT(apart, 0.03 * sum);
}

TEST(RoughLight, IsAsBrightInAFurnaceAsAllLight) {
    // Walls that emit 1 lm/m^2 and reflect a half: 1 of direct light, and as much of the other.
    const auto walls = paint(Rgb(0.5f), Rgb(1 / std::numbers::pi_v<float>));
    const Scene furnace = sceneOf({object("room", boxData({-1, -1, -1}, {1, 1, 1}, true, walls))});
    const PlacedScene placed = placeScene(furnace);
    const LitScene lit(placed, kCoarse, {});
    EXPECT_NEAR(roughLight(lit.patches(), lit.rays()).ambient.g, 1, 0.02);
}

TEST(RoughLight, IsGuessedWhereThereIsNotTheTimeForAllReceivers) {
    const MeshingOptions fine{.patchSize = 0.25f, .elementSize = 0.0625f};
    const Solution solution(shadowedRoom(), fine, {.directOnly = true});
    const std::vector<Rgb>& light = solution.lighting.direct;
    const RoughLight rough = roughLight(solution.patches(), solution.rays, light.size() / 2);
    ASSERT_EQ(rough.direct.size(), light.size());
    double sum = 0, apart = 0;
    for (std::size_t v = 0; v < light.size(); ++v) {
        sum += double(light[v].g);
        apart += std::abs(double(rough.direct[v].g) - double(light[v].g));
    }
    EXPECT_LT(apart, 0.1 * sum);
}

TEST(RoughLight, IsNotWorthItWithTooManyPairsAndThereIsNoneWithoutEmitters) {
    const Solution solution(shadowedRoom(), kCoarse, {.directOnly = true});
    EXPECT_TRUE(roughLight(solution.patches(), solution.rays, 100).empty());
    const Solution dark(sceneOf({object("room", boxData({-1, -1, -1}, {1, 1, 1}, true))}), kCoarse);
    EXPECT_TRUE(roughLight(dark.patches(), dark.rays).empty());
}

TEST(RoughLight, IsShownBeforeTheDirectLightIsKnownAndGoneAfterIt) {
    auto owned = std::make_unique<SteppedLink>();
    SteppedLink& link = *owned;
    LitRoom room(std::move(owned));
    const auto lit = [&] { return !room.node->objects().empty() && room.node->unlit().empty(); };
    room.node->update();
    for (int i = 0; i < 20 && !lit(); ++i) {
        link.step(0); // nothing is solved meanwhile
        room.node->update();
    }
    ASSERT_TRUE(lit());
    EXPECT_EQ(room.node->state().solution, SolutionState::working);
    float brightest = 0;
    for (const LitObject& object : room.node->objects()) {
        if (!object.geometry) continue; // a light
        for (const Rgb& light : object.geometry->data().direct)
            brightest = std::max(brightest, light.g);
    }
    EXPECT_GT(brightest, 0);
    for (int i = 0; i < 20000 && !room.node->state().reached(SolutionState::exact); ++i) {
        link.step(0.01);
        room.node->update();
    }
    EXPECT_EQ(room.difference(), "");
}

/// The floor reflects onto the light alone.
TEST(RoughLight, LeavesNoAmbientLightWhereNothingIsReflectedOntoAnything) {
    const RadiosityOptions options = LitRoom::smallRoomOptions();
    RadiosityNode node("lit", options, makeThreadLink());
    node.add(object("floor", floorData(-1, 1, -1, 1, 0, paint(Rgb(0.5f)))));
    node.add(ceilingLight({0, 0, 1}, 0.3f, 0.3f));
    ASSERT_TRUE(updateUntilSettled(node));
    EXPECT_EQ(differenceFromScratch(node, options), "");
    for (const LitObject& object : node.objects()) {
        if (!object.geometry || object.path != "/floor") continue;
        for (const Rgb& light : object.geometry->data().indirect) EXPECT_EQ(light, Rgb());
    }
}

} // namespace

} // namespace penumbra
