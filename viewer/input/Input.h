// What hands do with keyboard and mouse, in terms that know no window system.
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <bitset>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace penumbra {

/// A key by its position on the keyboard: letters and digits as they are on a US layout, by their
/// character, others by name.
enum class Key : std::uint8_t {
    unknown = 0,
    space = ' ',
    zero = '0',
    a = 'A',
    z = 'Z',
    // beyond ASCII
    escape = 128,
    enter,
    tab,
    backspace,
    remove,
    left,
    right,
    up,
    down,
    pageUp,
    pageDown,
    home,
    end,
    leftShift,
    rightShift,
    leftControl,
    rightControl,
    leftAlt,
    rightAlt,
    f1,
    f2,
    f3,
    f4,
    f5,
    f6,
    f7,
    f8,
    f9,
    f10,
    f11,
    f12,
};
/// The key of an upper case letter or a digit.
constexpr Key key(char character) {
    return Key(std::uint8_t(character));
}

struct Modifiers {
    bool shift = false, control = false, alt = false;
    friend bool operator==(Modifiers, Modifiers) = default;
};

enum class MouseButton : std::uint8_t { left, right, middle };

/// Positions are in pixels of the framebuffer, from its upper left corner, y down.
struct KeyEvent {
    Key key = Key::unknown;
    bool down = false;
    bool repeat = false; ///< held so long that the keyboard sends it again
    Modifiers modifiers = {};
    char letter = 0; ///< upper case, as the layout of the keyboard has it; 0: no letter
};
struct TextEvent {
    char32_t character = 0; ///< as the layout of the keyboard has it
};
struct MoveEvent {
    glm::dvec2 position{0.0};
    glm::dvec2 moved{0.0}; ///< since the last one
};
struct ButtonEvent {
    MouseButton button = MouseButton::left;
    bool down = false;
    Modifiers modifiers = {};
    glm::dvec2 position{0.0};
};
struct ScrollEvent {
    glm::dvec2 offset{0.0}; ///< in notches of a wheel; up and left are positive
    Modifiers modifiers = {};
};
/// The window came to the front or went to the back.
struct FocusEvent {
    bool focused = false;
};

/// Files were dropped on the window.
struct DropEvent {
    std::vector<std::string> files; ///< paths; at least one
};

using InputEvent =
    std::variant<KeyEvent, TextEvent, MoveEvent, ButtonEvent, ScrollEvent, FocusEvent, DropEvent>;

/// What is held down at the moment, and where the pointer is.
class InputState {
public:
    void take(const InputEvent& event);
    /// Lets go of everything: the window lost the keyboard, or a panel took it.
    void release() { keys_.reset(), buttons_.fill(false), modifiers_ = {}; }
    void releaseKeys() { keys_.reset(), modifiers_ = {}; }

    bool held(Key key) const { return keys_[std::uint8_t(key)]; }
    bool held(MouseButton button) const { return buttons_[std::size_t(button)]; }
    Modifiers modifiers() const { return modifiers_; }
    glm::dvec2 position() const { return position_; }

private:
    std::bitset<256> keys_;
    std::array<bool, 3> buttons_{};
    Modifiers modifiers_;
    glm::dvec2 position_{0.0};
};

} // namespace penumbra
