// What is held down.
#include "viewer/input/Input.h"

#include <gtest/gtest.h>

namespace penumbra {

namespace {

TEST(InputState, KnowsWhatIsHeldAndWhereThePointerIs) {
    InputState state;
    state.take(KeyEvent{.key = key('W'), .down = true});
    state.take(KeyEvent{.key = Key::rightShift, .down = true});
    state.take(ButtonEvent{.button = MouseButton::middle, .down = true, .position = {3, 4}});
    EXPECT_TRUE(state.held(key('W')));
    EXPECT_TRUE(state.held(MouseButton::middle));
    EXPECT_FALSE(state.held(MouseButton::left));
    EXPECT_EQ(state.modifiers(), (Modifiers{.shift = true}));
    EXPECT_EQ(state.position(), glm::dvec2(3, 4));
    state.take(KeyEvent{.key = key('W'), .down = false});
    state.take(MoveEvent{.position = {7, 8}});
    EXPECT_FALSE(state.held(key('W')));
    EXPECT_EQ(state.position(), glm::dvec2(7, 8));
}

TEST(InputState, LetsGoOfEverythingWhenTheWindowLosesTheKeyboard) {
    InputState state;
    state.take(KeyEvent{.key = key('A'), .down = true});
    state.take(KeyEvent{.key = Key::leftControl, .down = true});
    state.take(FocusEvent{false});
    EXPECT_FALSE(state.held(key('A')));
    EXPECT_EQ(state.modifiers(), Modifiers{});
}

} // namespace

} // namespace penumbra
