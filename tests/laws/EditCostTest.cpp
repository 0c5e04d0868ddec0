// Colours and luminances move no form factor: taking them in traces no ray. A move costs what it
// changes.
#include "tests/support/Scenes.h"

#include <gtest/gtest.h>

namespace penumbra {

namespace {

/// A room with a light that is on and one that is off, an emissive panel, a black box and a screen.
struct PaintedRoom {
    std::shared_ptr<Material> walls = paint({0.7f, 0.5f, 0.3f}), black = paint(Rgb()),
                              panel = paint(Rgb(0.2f), Rgb(5));
    std::shared_ptr<Light> light = std::make_shared<Light>("light", RectShape{0.6f, 0.4f}, Rgb(10));
    std::shared_ptr<Light> off = std::make_shared<Light>("light", SphereShape{0.1f}, Rgb());
    Scene scene = sceneOf(
        {object("room", boxData({-1, -1, -1}, {1, 1, 1}, true, walls)),
         objectOf("box",
                  {std::make_shared<Mesh>(
                      "mesh", boxData({-0.5f, -0.3f, -1}, {0.1f, 0.4f, -0.2f}, false, black))}),
         object("screen", floorData(0.3f, 0.9f, -0.5f, 0.5f, 0.1f)),
         object("panel", floorData(-0.9f, -0.6f, -0.5f, 0.5f, -0.9f, panel)),
         placed("lamp", moved(0, 0, 0.99), {light}), placed("off", moved(0.6, 0.6, -0.5), {off})});
};

class EditCost : public testing::Test {
protected:
    EditCost() { lit.solver().settle(); }

    std::uint64_t rays() const {
        const SolveStatistics s = lit.solver().statistics();
        return s.direct.rays.total() + s.indirect.rays.total() + s.detail.rays.total();
    }
    /// Takes in an edit to the end; what the floor's first patch sends tells whether it was seen.
    void expectNoRay(const char* what) {
        const std::uint64_t before = rays();
        const std::vector<Rgb> sent = lit.solver().radiosity();
        EXPECT_FALSE(lit.follow(placeScene(room.scene)).rebuilt) << what;
        lit.solver().settle();
        EXPECT_EQ(lit.solver().statistics().state, SolutionState::exact) << what;
        EXPECT_EQ(rays(), before) << what;
        EXPECT_NE(lit.solver().radiosity(), sent) << what;
    }

    PaintedRoom room;
    LitScene lit{placeScene(room.scene), {.patchSize = 0.4f, .elementSize = 0.2f}, {}};
};

TEST_F(EditCost, DimmingSwitchingAndRecolouringALightTraceNoRay) {
    room.light->setLuminance(Rgb(3));
    expectNoRay("dimmed");
    room.light->setLuminance({3, 9, 1});
    expectNoRay("recoloured");
    room.light->setLuminance(Rgb());
    expectNoRay("switched off");
    room.light->setLuminance(Rgb(10));
    expectNoRay("switched on again");
}

TEST_F(EditCost, SwitchingOnALightThatNeverShoneTracesNoRay) {
    room.off->setLuminance({1, 20, 40});
    expectNoRay("a light that was loaded dark");
}

TEST_F(EditCost, AnEmittingSurfaceIsDimmedAndSwitchedLikeALight) {
    room.panel->setEmission({1, 2, 3});
    expectNoRay("dimmed");
    room.panel->setEmission(Rgb());
    expectNoRay("switched off");
    room.panel->setEmission(Rgb(5));
    expectNoRay("switched on again");
}

TEST_F(EditCost, RepaintingTracesNoRayEvenWhereNothingWasReflectedBefore) {
    // Black surfaces have rows too: those that light reaches are completed when all is settled.
    room.walls->setReflectance({0.1f, 0.8f, 0.8f});
    expectNoRay("repainted");
    room.black->setReflectance(Rgb(0.8f));
    expectNoRay("painted white what was black from the start");
    room.walls->setReflectance(Rgb());
    expectNoRay("painted black");
    room.walls->setReflectance(Rgb(0.7f));
    expectNoRay("painted again");
}

TEST_F(EditCost, WhatDidNotShineWhenTheSceneWasMeshedIsAloneMeshedAnewToShine) {
    // An emitting face is cut and sampled as one, which is decided when meshing.
    room.black->setEmission(Rgb(1));
    const LitScene::Followed followed = lit.follow(placeScene(room.scene));
    EXPECT_FALSE(followed.rebuilt);
    EXPECT_TRUE(followed.added);
    lit.solver().settle();
    room.black->setEmission(Rgb(2));
    expectNoRay("brightened");
}

TEST_F(EditCost, FollowingNoEditChangesNothing) {
    const std::uint64_t before = rays();
    const std::vector<Rgb> sent = lit.solver().radiosity();
    const LitScene::Followed followed = lit.follow(placeScene(room.scene));
    EXPECT_FALSE(followed.rebuilt);
    EXPECT_TRUE(followed.change.empty());
    lit.solver().settle();
    EXPECT_EQ(rays(), before);
    EXPECT_EQ(lit.solver().radiosity(), sent);
}

TEST_F(EditCost, AMoveTracesFewerRaysThanTheSceneDoesFromScratch) {
    auto& box = dynamic_cast<Transform&>(*room.scene.root->children()[1]);
    const std::uint64_t scratch = rays();
    box.setMatrix(moved(0.01, 0, 0));
    EXPECT_FALSE(lit.follow(placeScene(room.scene)).rebuilt);
    lit.solver().settle();
    EXPECT_LT(rays() - scratch, scratch);
}

/// Closed rooms of 2 m in a row, each with a light and a box that moves.
Scene roomsInARow(int count, std::vector<std::shared_ptr<Transform>>& boxes) {
    std::vector<NodePtr> nodes;
    for (int i = 0; i < count; ++i) {
        const std::string n = std::to_string(i);
        const float x = 2.2f * float(i);
        nodes.push_back(object("room" + n, boxData({x - 1, -1, -1}, {x + 1, 1, 1}, true)));
        nodes.push_back(placed("lamp" + n, moved(x, 0, 0.99),
                               {std::make_shared<Light>("light", RectShape{0.6f, 0.4f}, Rgb(10))}));
        const auto box = std::make_shared<Mesh>(
            "mesh", boxData({x - 0.3f, -0.3f, -1}, {x + 0.1f, 0.4f, -0.4f}, false));
        nodes.push_back(objectOf("box" + n, {box}));
        boxes.push_back(std::dynamic_pointer_cast<Transform>(nodes.back()));
    }
    Scene scene;
    scene.root = std::make_shared<Group>("root");
    for (NodePtr& node : nodes) scene.root->add(node);
    return scene;
}

TEST(EditCostOfRooms, AMoveCostsWhatItCostsInItsOwnRoomAndRowsGrowWithTheRoomsAlone) {
    struct Cost {
        double entries, moveRays, moveBlocks;
    };
    const auto costOf = [](int rooms) {
        std::vector<std::shared_ptr<Transform>> boxes;
        const Scene scene = roomsInARow(rooms, boxes);
        LitScene lit(placeScene(scene), {.patchSize = 0.5f, .elementSize = 0.125f},
                     {.directOnly = true});
        lit.solver().settle();
        const auto raysSoFar = [&] {
            return double(lit.solver().statistics().direct.rays.total());
        };
        const auto blocksSoFar = [&] {
            return double(lit.solver().statistics().direct.blocksVisited);
        };
        const double before = raysSoFar(), visited = blocksSoFar();
        const auto entries = double(lit.solver().statistics().entries);
        boxes.front()->setMatrix(moved(0.2, 0.1, 0));
        EXPECT_FALSE(lit.follow(placeScene(scene)).rebuilt);
        lit.solver().settle();
        return Cost{entries, raysSoFar() - before, blocksSoFar() - visited};
    };
    const Cost one = costOf(1), four = costOf(4);
    EXPECT_NEAR(four.entries, 4 * one.entries, 0.01 * four.entries);
    EXPECT_GT(one.moveRays, 1000);
    EXPECT_NEAR(four.moveRays, one.moveRays, 0.01 * one.moveRays);
    EXPECT_GT(one.moveBlocks, 10);
    EXPECT_EQ(four.moveBlocks, one.moveBlocks) << "no row of the other rooms' lights is read";
}

TEST(EditCostOfRooms, WhatIsBroughtInResizedOrTakenOutCostsTheRaysOfAMove) {
    std::vector<std::shared_ptr<Transform>> boxes;
    const Scene scene = roomsInARow(3, boxes);
    for (const bool directOnly : {true, false}) {
        LitScene lit(placeScene(scene), {.patchSize = 0.5f, .elementSize = 0.125f},
                     {.directOnly = directOnly, .detail = false});
        lit.solver().settle();
        const auto raysOf = [&](bool adds) {
            const std::uint64_t before = lit.solver().done().rays;
            const LitScene::Followed followed = lit.follow(placeScene(scene));
            EXPECT_FALSE(followed.rebuilt);
            EXPECT_EQ(followed.added, adds);
            lit.solver().settle();
            return double(lit.solver().done().rays - before);
        };
        boxes.front()->setMatrix(moved(0.2, 0.1, 0));
        const double move = raysOf(false);
        const auto another = std::make_shared<Transform>("another");
        for (const NodePtr& child : boxes.front()->children()) another->add(child);
        another->setBeginsObject(true);
        another->setMatrix(moved(-0.3, 0.1, 0));
        scene.root->add(another);
        EXPECT_LT(raysOf(true), 1.2 * move);
        another->setMatrix(another->matrix() * scaled(1.1));
        EXPECT_LT(raysOf(true), 1.2 * move);
        scene.root->remove(another);
        EXPECT_LT(raysOf(false), 0.7 * move);
        boxes.front()->setMatrix(moved(0, 0, 0));
        raysOf(false);
    }
}

} // namespace

} // namespace penumbra
