#include "viewer/input/MotionControls.h"

#include <algorithm>
#include <numbers>
#include <utility>

namespace penumbra {

namespace {

constexpr double kLookTurn = 0.1 * std::numbers::pi / 180; // [rad/pixel]
constexpr double kOrbitTurn = std::numbers::pi;            // across the picture's height [rad]
constexpr double kZoomNotches = 30;                        // across the picture's height
constexpr double kScrollTurn = 0.05;                       // sideways on a touchpad [rad/notch]

} // namespace

void MotionControls::take(const InputEvent& event, int pictureHeight) {
    state_.take(event);
    if (const auto* pressed = std::get_if<KeyEvent>(&event)) {
        const Modifiers with = state_.modifiers();
        if (pressed->key >= key('A') && pressed->key <= key('Z') && !pressed->repeat)
            shortcuts_.set(std::size_t(pressed->key), pressed->down && (with.control || with.alt));
    } else if (const auto* move = std::get_if<MoveEvent>(&event)) {
        const glm::dvec2 share = move->moved / double(std::max(1, pictureHeight));
        switch (gesture_) {
        case Gesture::look:
            gathered_.turn += sensitivity * kLookTurn * glm::dvec2(move->moved.x, -move->moved.y);
            break;
        case Gesture::orbit: // the things are turned, hence the camera the other way
            gathered_.orbit += kOrbitTurn * glm::dvec2(share.x, -share.y);
            break;
        case Gesture::pan: // the things follow the pointer
            gathered_.pan += glm::dvec2(-share.x, share.y);
            break;
        case Gesture::zoom:
            gathered_.dolly -= kZoomNotches * share.y;
            break;
        case Gesture::none:
            break;
        }
    } else if (const auto* scroll = std::get_if<ScrollEvent>(&event)) {
        gathered_.dolly += scroll->offset.y;
        gathered_.turn.x -= kScrollTurn * scroll->offset.x;
    } else if (const auto* focus = std::get_if<FocusEvent>(&event)) {
        if (!focus->focused) release();
    }
}

void MotionControls::release() {
    state_.release();
    shortcuts_.reset();
    end();
}

MotionInput MotionControls::takeMotion() {
    MotionInput motion = std::exchange(gathered_, {});
    if (state_.modifiers().control || state_.modifiers().alt) return motion; // a shortcut
    const auto axis = [&](char positive, char negative) {
        return double(moves(positive)) - double(moves(negative));
    };
    motion.move = {axis('D', 'A'), axis('W', 'S'), axis('E', 'Q')};
    motion.run = state_.modifiers().shift;
    return motion;
}

} // namespace penumbra
