// A scene and the person in it, driven by events alone.
#include "viewer/Walkthrough.h"

#include "tests/scenegraph/SceneParts.h"

#include <gtest/gtest.h>

namespace penumbra {

namespace {

constexpr glm::ivec2 kPicture{800, 600};

/// A floor of 40 m with two cameras that look north.
ReadyScene field() {
    ReadyScene ready;
    ready.loaded.scene = std::make_shared<Scene>();
    Scene& scene = *ready.loaded.scene;
    scene.upAxis = UpAxis::z;
    scene.root->add(polygon("floor", {{-20, -20, 0}, {20, -20, 0}, {20, 20, 0}, {-20, 20, 0}}));
    Lens lens;
    lens.clippingRange = {0.01f, 100};
    for (const double x : {0.0, 5.0}) {
        const CameraPose pose{{x, 0, 1.65}, 0, 0};
        scene.root->add(placed("stand" + std::to_string(int(x)), pose.toWorld(Compass(UpAxis::z)),
                               {std::make_shared<Camera>("Eye", lens)}));
    }
    ready.placed = placeScene(scene);
    ready.rays = std::make_unique<SceneRays>(ready.placed);
    return ready;
}

void letPass(Walkthrough& walk, double seconds) {
    for (int i = 0; i < 60; ++i) walk.advance(seconds / 60);
}

TEST(Walkthrough, WalksAsLongAsAKeyIsHeld) {
    Walkthrough walk(field());
    walk.take(KeyEvent{.key = key('W'), .down = true}, kPicture);
    EXPECT_TRUE(walk.moving());
    letPass(walk, 2);
    walk.take(KeyEvent{.key = key('W'), .down = false}, kPicture);
    letPass(walk, 1);
    EXPECT_NEAR(walk.rig().pose().eye.y, 2 * walk.rig().options.speed, 1e-3);
    EXPECT_FALSE(walk.moving());
}

TEST(Walkthrough, TheRightButtonLooksAroundAndHoldsThePointer) {
    Walkthrough walk(field());
    walk.take(ButtonEvent{.button = MouseButton::right, .down = true}, kPicture);
    EXPECT_TRUE(walk.wantsPointer());
    walk.take(MoveEvent{.moved = {100, 0}}, kPicture);
    walk.take(ButtonEvent{.button = MouseButton::right, .down = false}, kPicture);
    EXPECT_FALSE(walk.wantsPointer());
    walk.take(MoveEvent{.moved = {100, 0}}, kPicture);
    walk.advance(0.01);
    EXPECT_NEAR(walk.rig().pose().heading, 100 * 0.1 * 3.14159265 / 180, 1e-6);
}

TEST(Walkthrough, TheMiddleButtonCirclesAroundWhatIsUnderThePointer) {
    Walkthrough walk(field());
    const glm::dvec2 below(400, 500);
    walk.take(ButtonEvent{.button = MouseButton::middle, .down = true, .position = below},
              kPicture);
    const glm::dvec3 centre = walk.rig().orbitCentre();
    EXPECT_NEAR(centre.z, 0, 1e-5) << "on the floor";
    EXPECT_GT(centre.y, 1);
    const double distance = glm::distance(walk.rig().pose().eye, centre);
    walk.take(MoveEvent{.position = {500, 500}, .moved = {100, 0}}, kPicture);
    walk.advance(0.01);
    EXPECT_NEAR(glm::distance(walk.rig().pose().eye, centre), distance, 1e-6);
    EXPECT_GT(std::abs(walk.rig().pose().eye.x), 0.1);
}

TEST(Walkthrough, CommandsGoToBookmarksAndSwitchTheWayOfMoving) {
    Walkthrough walk(field());
    ASSERT_EQ(walk.bookmarks().size(), 2u);
    walk.perform({Action::bookmark, 2});
    letPass(walk, 1);
    EXPECT_NEAR(walk.rig().pose().eye.x, 5, 1e-9);
    walk.perform({Action::bookmark, 7}); // there is none
    walk.perform({Action::gravity});
    EXPECT_FALSE(walk.rig().options.gravity);
    walk.perform({Action::collision});
    EXPECT_TRUE(walk.rig().options.collision);
    for (const CameraMode mode : {CameraMode::fly, CameraMode::orbit, CameraMode::walk}) {
        walk.perform({Action::nextMode});
        EXPECT_EQ(walk.rig().mode(), mode);
    }
}

} // namespace

} // namespace penumbra
