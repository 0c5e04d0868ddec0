// Hands to motion.
#include "viewer/input/MotionControls.h"

#include <gtest/gtest.h>

namespace penumbra {

namespace {

constexpr int kHeight = 500;

TEST(MotionControls, KeysAreReadAsLongAsTheyAreHeld) {
    MotionControls controls;
    controls.take(KeyEvent{.key = key('W'), .down = true}, kHeight);
    controls.take(KeyEvent{.key = key('A'), .down = true}, kHeight);
    controls.take(KeyEvent{.key = Key::leftShift, .down = true}, kHeight);
    for (int frame = 0; frame < 2; ++frame) {
        const MotionInput motion = controls.takeMotion();
        EXPECT_EQ(motion.move, glm::dvec3(-1, 1, 0));
        EXPECT_TRUE(motion.run);
    }
    controls.take(KeyEvent{.key = key('D'), .down = true}, kHeight);
    EXPECT_EQ(controls.takeMotion().move, glm::dvec3(0, 1, 0)) << "left and right cancel";
    controls.take(KeyEvent{.key = Key::leftControl, .down = true}, kHeight);
    EXPECT_EQ(controls.takeMotion().move, glm::dvec3(0)) << "Ctrl+D is no step to the right";
}

TEST(MotionControls, AShortcutOfWhichCtrlIsLetGoFirstIsNoStep) {
    MotionControls controls;
    const auto press = [&](Key which, bool down, bool repeat = false) {
        controls.take(KeyEvent{.key = which, .down = down, .repeat = repeat}, kHeight);
    };
    for (const Key with : {Key::leftControl, Key::rightAlt}) {
        press(with, true);
        press(key('D'), true);
        press(with, false);
        EXPECT_EQ(controls.takeMotion().move, glm::dvec3(0));
        press(key('D'), true, true);
        EXPECT_EQ(controls.takeMotion().move, glm::dvec3(0)) << "the keyboard sends it again";
        EXPECT_FALSE(controls.moves('D'));
        press(key('D'), false);
        press(key('D'), true);
        EXPECT_EQ(controls.takeMotion().move, glm::dvec3(1, 0, 0)) << "pressed alone";
        press(key('D'), false);
    }
}

TEST(MotionControls, ThePointerTurnsTheViewOnlyDuringAGestureAndCountsOnce) {
    MotionControls controls;
    controls.take(MoveEvent{.moved = {10, 0}}, kHeight);
    EXPECT_TRUE(controls.takeMotion().idle());
    controls.begin(MotionControls::Gesture::look);
    controls.take(MoveEvent{.moved = {10, -5}}, kHeight);
    controls.take(MoveEvent{.moved = {10, -5}}, kHeight);
    const MotionInput motion = controls.takeMotion();
    EXPECT_GT(motion.turn.x, 0) << "to the right";
    EXPECT_NEAR(motion.turn.y, motion.turn.x / 2, 1e-12) << "up";
    EXPECT_TRUE(controls.takeMotion().idle());
    controls.end();
    controls.take(MoveEvent{.moved = {10, 0}}, kHeight);
    EXPECT_TRUE(controls.takeMotion().idle());
}

TEST(MotionControls, OrbitPanAndZoomGoByThePictureNotByPixels) {
    for (const int height : {500, 1000}) {
        MotionControls controls;
        controls.begin(MotionControls::Gesture::orbit);
        controls.take(MoveEvent{.moved = {0.5 * height, 0}}, height);
        EXPECT_NEAR(controls.takeMotion().orbit.x, 3.14159265 / 2, 1e-6);
        controls.begin(MotionControls::Gesture::pan);
        controls.take(MoveEvent{.moved = {0.25 * height, 0}}, height);
        EXPECT_DOUBLE_EQ(controls.takeMotion().pan.x, -0.25);
        controls.begin(MotionControls::Gesture::zoom);
        controls.take(MoveEvent{.moved = {0, 0.1 * height}}, height);
        EXPECT_LT(controls.takeMotion().dolly, 0) << "pulled down: back";
    }
}

TEST(MotionControls, TheWheelGoesForwardAndATouchpadTurns) {
    MotionControls controls;
    controls.take(ScrollEvent{.offset = {0, 2}}, kHeight);
    controls.take(ScrollEvent{.offset = {1, 0}}, kHeight);
    const MotionInput motion = controls.takeMotion();
    EXPECT_DOUBLE_EQ(motion.dolly, 2);
    EXPECT_LT(motion.turn.x, 0);
}

TEST(MotionControls, NothingGoesOnWhenTheKeyboardIsLost) {
    MotionControls controls;
    controls.begin(MotionControls::Gesture::look);
    controls.take(KeyEvent{.key = key('W'), .down = true}, kHeight);
    controls.take(FocusEvent{false}, kHeight);
    controls.take(MoveEvent{.moved = {10, 0}}, kHeight);
    EXPECT_TRUE(controls.takeMotion().idle());
}

} // namespace

} // namespace penumbra
