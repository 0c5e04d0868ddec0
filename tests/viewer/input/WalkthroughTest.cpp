// A scene and the person in it, driven by events alone.
#include "viewer/input/Walkthrough.h"

#include "tests/scenegraph/SceneParts.h"

#include <gtest/gtest.h>

#include <cmath>

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
    const auto box =
        objectOf("box", {polygon("front", {{-.5f, 0, 0}, {.5f, 0, 0}, {.5f, 0, 1}, {-.5f, 0, 1}})});
    box->setMatrix(glm::translate(glm::dmat4(1.0), {0, 4, 0}));
    scene.root->add(box);
    scene.root->add(
        placed("crate", glm::translate(glm::dmat4(1.0), {3, 4, 0}),
               {polygon("side", {{-.5f, 0, 0}, {.5f, 0, 0}, {.5f, 0, 1}, {-.5f, 0, 1}})}));
    scene.root->add(placed("hook", glm::translate(glm::dmat4(1.0), {-3, 4, 3}), {light("lamp")}));
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

/// Where a point of the scene is in the picture [pixel].
glm::dvec2 pixelOf(const Walkthrough& walk, glm::dvec3 place) {
    const View view = walk.rig().view(kPicture.x, kPicture.y);
    const glm::dvec4 clip = view.worldToClip() * glm::dvec4(place, 1);
    return glm::dvec2(1 + clip.x / clip.w, 1 - clip.y / clip.w) / 2.0 * glm::dvec2(kPicture);
}

void press(Walkthrough& walk, glm::dvec2 at, bool down = true) {
    walk.take(ButtonEvent{.button = MouseButton::left, .down = down, .position = at}, kPicture);
}
void moveTo(Walkthrough& walk, glm::dvec2 from, glm::dvec2 to) {
    walk.take(MoveEvent{.position = to, .moved = to - from}, kPicture);
}

TEST(Walkthrough, DragsAThingOverTheFloorAndTakesThatBack) {
    Walkthrough walk(field());
    const glm::dvec3 hold(0, 4, 0.5), there(1, 5, 0.5);
    const glm::dvec2 from = pixelOf(walk, hold), to = pixelOf(walk, there);
    press(walk, from);
    ASSERT_TRUE(walk.selection());
    EXPECT_EQ(walk.selection()->objectPath, "/box");
    EXPECT_EQ(walk.inHand(), walk.selection()->node) << "before it moves";
    EXPECT_EQ(walk.revision(), 1u) << "a click, so far";
    moveTo(walk, from, to);
    const auto revision = walk.revision();
    EXPECT_EQ(walk.inHand(), walk.selection()->node);
    press(walk, to, false);
    EXPECT_EQ(walk.inHand(), nullptr);
    EXPECT_GT(walk.revision(), 1u);
    EXPECT_GE(walk.revision(), revision);
    const auto place = [&] { return glm::dvec3(walk.selection()->node->matrix()[3]); };
    EXPECT_LT(glm::distance(place(), glm::dvec3(1, 5, 0)), 1e-4);
    EXPECT_EQ(walk.placed().objects[walk.selection()->object.value].toWorld[3].x, place().x);
    walk.perform({Action::undo});
    EXPECT_EQ(place(), glm::dvec3(0, 4, 0));
    walk.perform({Action::redo});
    EXPECT_LT(glm::distance(place(), glm::dvec3(1, 5, 0)), 1e-4);
}

TEST(Walkthrough, DragsAtOnceWhatNoFileMarks) {
    Walkthrough walk(field());
    const glm::dvec2 from = pixelOf(walk, {3, 4, 0.5}), to = pixelOf(walk, {2, 5, 0.5});
    press(walk, from);
    ASSERT_TRUE(walk.selection());
    EXPECT_EQ(walk.selection()->objectPath, "/crate");
    moveTo(walk, from, to);
    press(walk, to, false);
    const auto place = [&] { return glm::dvec3(walk.selection()->node->matrix()[3]); };
    EXPECT_LT(glm::distance(place(), glm::dvec3(2, 5, 0)), 1e-4);
    EXPECT_EQ(walk.placed().objects[walk.selection()->object.value].path, "/crate");
    walk.perform({Action::undo});
    EXPECT_EQ(place(), glm::dvec3(3, 4, 0));
    EXPECT_FALSE(walk.history().edited());
    walk.perform({Action::redo});
    EXPECT_LT(glm::distance(place(), glm::dvec3(2, 5, 0)), 1e-4);
    walk.perform({Action::nudge, int(NudgeDirection::right), true});
    EXPECT_LT(glm::distance(place(), glm::dvec3(2.1, 5, 0)), 1e-4);
}

/// The field with a shell around the camera, 8 m wide and 6 m high, that opens to the north.
ReadyScene hall() {
    ReadyScene ready = field();
    ready.loaded.scene->root->add(
        placed("hall", glm::translate(glm::dmat4(1.0), {0, 0, -0.5}),
               {polygon("back", {{-4, 9, 0}, {4, 9, 0}, {4, 9, 6}, {-4, 9, 6}}),
                polygon("left", {{-4, -1, 0}, {-4, 9, 0}, {-4, 9, 6}, {-4, -1, 6}})}));
    ready.placed = placeScene(*ready.loaded.scene);
    ready.rays = std::make_unique<SceneRays>(ready.placed);
    return ready;
}

TEST(Walkthrough, WhatIsAroundTheCameraIsSelectedByOneClickAndDraggedByTheNext) {
    Walkthrough walk(hall());
    const glm::dvec3 hold(-0.8, 9, 2);
    const glm::dvec2 from = pixelOf(walk, hold);
    press(walk, from);
    ASSERT_TRUE(walk.selection());
    EXPECT_EQ(walk.selection()->objectPath, "/hall");
    EXPECT_EQ(walk.inHand(), nullptr) << "the view turns, nothing is moved";
    moveTo(walk, from, from + glm::dvec2(20, 0));
    press(walk, from, false);
    EXPECT_EQ(walk.revision(), 1u);
    walk.advance(0.01);
    const glm::dvec2 again = pixelOf(walk, hold);
    press(walk, again);
    EXPECT_EQ(walk.inHand(), walk.selection()->node);
    moveTo(walk, again, again + glm::dvec2(100, 0));
    press(walk, again, false);
    EXPECT_NE(walk.selection()->node->matrix()[3].x, 0);
    walk.perform({Action::undo});
    EXPECT_EQ(glm::dvec3(walk.selection()->node->matrix()[3]), glm::dvec3(0, 0, -0.5));
}

TEST(Walkthrough, WhatTheCameraStandsOnIsAroundIt) {
    ReadyScene ready = field();
    ready.loaded.scene->root->add(
        placed("carpet", glm::translate(glm::dmat4(1.0), {0, 0, 0.01}),
               {polygon("top", {{-2, -1, 0}, {2, -1, 0}, {2, 30, 0}, {-2, 30, 0}})}));
    ready.placed = placeScene(*ready.loaded.scene);
    ready.rays = std::make_unique<SceneRays>(ready.placed);
    Walkthrough walk(std::move(ready));
    const glm::dvec2 at = pixelOf(walk, {0.9, 6, 0});
    press(walk, at);
    ASSERT_TRUE(walk.selection());
    EXPECT_EQ(walk.selection()->objectPath, "/carpet");
    EXPECT_EQ(walk.inHand(), nullptr);
}

TEST(Walkthrough, EscapePutsBackWhatIsBeingDragged) {
    Walkthrough walk(field());
    const glm::dvec2 from = pixelOf(walk, {0, 4, 0.5});
    press(walk, from);
    moveTo(walk, from, from + glm::dvec2(100, 0));
    walk.perform({Action::cancel});
    EXPECT_EQ(glm::dvec3(walk.selection()->node->matrix()[3]), glm::dvec3(0, 4, 0));
    EXPECT_EQ(walk.history().undoable(), 0u);
    moveTo(walk, from, from + glm::dvec2(200, 0)); // the button is still down
    EXPECT_EQ(glm::dvec3(walk.selection()->node->matrix()[3]), glm::dvec3(0, 4, 0));
}

TEST(Walkthrough, AClickSelectsAndWhatStandsBelowNoTransformIsLookedAroundWith) {
    Walkthrough walk(field());
    const glm::dvec2 floor(400, 580);
    press(walk, floor);
    ASSERT_TRUE(walk.selection());
    EXPECT_EQ(walk.selection()->path, "/floor");
    moveTo(walk, floor, floor + glm::dvec2(50, 0));
    walk.advance(0.01);
    EXPECT_GT(walk.rig().pose().heading, 0.05);
    EXPECT_EQ(walk.history().undoable(), 0u);
    walk.perform({Action::nudge, int(NudgeDirection::left)});
    EXPECT_EQ(walk.history().undoable(), 0u) << "the floor stays";
}

TEST(Walkthrough, NudgesAndTurnsWhatIsSelected) {
    Walkthrough walk(field());
    press(walk, pixelOf(walk, {0, 4, 0.5}));
    press(walk, pixelOf(walk, {0, 4, 0.5}), false);
    const auto& matrix = [&]() -> const glm::dmat4& { return walk.selection()->node->matrix(); };
    walk.perform({Action::nudge, int(NudgeDirection::right), true});
    EXPECT_LT(glm::distance(glm::dvec3(matrix()[3]), glm::dvec3(0.1, 4, 0)), 1e-12);
    walk.perform({Action::nudge, int(NudgeDirection::farther)});
    walk.perform({Action::nudge, int(NudgeDirection::up)});
    EXPECT_LT(glm::distance(glm::dvec3(matrix()[3]), glm::dvec3(0.1, 4.01, 0.01)), 1e-12);
    walk.perform({Action::turnLeft});
    EXPECT_NEAR(matrix()[0].y, std::sin(15 * 3.14159265358979 / 180), 1e-12);
    walk.perform({Action::undo}); // a burst of keys is one step
    EXPECT_EQ(matrix()[3], glm::dvec4(0, 4, 0, 1));
}

TEST(Walkthrough, DimsAndSwitchesLights) {
    Walkthrough walk(field());
    const auto nits = [&] { return walk.placed().lights[0].node->luminance().r; };
    walk.brighten(-1); // nothing is selected: all lights
    EXPECT_FLOAT_EQ(nits(), 50);
    walk.advance(2);
    const auto touch = walk.rays().touch({-3, 4, 2}, {0, 0, 1}, 10);
    ASSERT_TRUE(touch);
    walk.select(selectionOf(walk.scene(), walk.placed(), *touch));
    walk.perform({Action::switchLight});
    EXPECT_EQ(nits(), 0);
    walk.perform({Action::switchLight});
    EXPECT_FLOAT_EQ(nits(), 50);
    walk.perform({Action::undo});
    EXPECT_FLOAT_EQ(nits(), 50) << "off and on again at once is nothing";
    walk.perform({Action::undo});
    EXPECT_FLOAT_EQ(nits(), 100);
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
