#include "viewer/input/Input.h"

namespace penumbra {

void InputState::take(const InputEvent& event) {
    if (const auto* pressed = std::get_if<KeyEvent>(&event)) {
        keys_[std::uint8_t(pressed->key)] = pressed->down;
        const auto either = [&](Key left, Key right) { return held(left) || held(right); };
        modifiers_ = {either(Key::leftShift, Key::rightShift),
                      either(Key::leftControl, Key::rightControl),
                      either(Key::leftAlt, Key::rightAlt)};
    } else if (const auto* button = std::get_if<ButtonEvent>(&event)) {
        buttons_[std::size_t(button->button)] = button->down;
        position_ = button->position;
    } else if (const auto* move = std::get_if<MoveEvent>(&event)) {
        position_ = move->position;
    } else if (const auto* focus = std::get_if<FocusEvent>(&event)) {
        if (!focus->focused) release();
    }
}

} // namespace penumbra
