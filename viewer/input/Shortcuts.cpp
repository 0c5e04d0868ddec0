#include "viewer/input/Shortcuts.h"

#include <array>

namespace penumbra {

namespace {

constexpr std::array kHelp = std::to_array<HelpLine>({
    {"Move", "W A S D", "ahead, left, back, right (Shift: run)"},
    {"Move", "E Q", "up, down (flying, or without gravity)"},
    {"Move", "right mouse button", "look around; also the left one, on what is around you"},
    {"Move", "mouse wheel", "forward, back; sideways: turn"},
    {"Move", "middle button, Alt+left", "circle around what is under the pointer"},
    {"Move", "Shift+middle, Alt+middle", "shift the view (Alt+right: nearer, farther)"},
    {"Move", "Tab", "walk, fly, orbit"},
    {"Move", "G", "gravity on, off"},
    {"Move", "C", "walls stop you, or not"},
    {"Move", "1 ... 9", "the cameras of the file"},
    {"Move", "Home", "the whole scene"},
    {"Move", "F", "what is selected"},
    {"Edit", "left mouse button", "select; drag along what the thing stands or hangs on"},
    {"Edit", "...", "(what is around you, above or below: click on it first)"},
    {"Edit", "... with Shift", "up and down"},
    {"Edit", "... with Ctrl", "turn"},
    {"Edit", "arrows, Page up, down", "nudge what is selected by 1 cm (Shift: 10 cm)"},
    {"Edit", "R  Shift+R", "turn it by 15 degrees"},
    {"Edit", "-  +", "dim or brighten the selected light, or all lights, by a quarter"},
    {"Edit", "L", "the light off and on"},
    {"Edit", "Del", "remove what is selected"},
    {"Edit", "H  Shift+H", "hide it; show all that is hidden"},
    {"Edit", "Ctrl+D", "another one of it, beside it"},
    {"Edit", "Ctrl+Z  Ctrl+Y", "undo, redo (also Ctrl+Shift+Z)"},
    {"Edit", "Esc", "put back what is being dragged; select nothing"},
    {"View", "[  ]", "darker, brighter (exposure)"},
    {"View", "\\", "automatic exposure, or fixed"},
    {"View", "T", "next tone curve: AgX, ACES, sRGB"},
    {"View", "O  Shift+O", "show on top: mesh, age of the light, light still to compute,"},
    {"View", "...", "what is computed first, why it is dark at the pointer"},
    {"View", "N", "panels on, off"},
    {"View", "F11", "full screen"},
    {"View", "?", "this help"},
    {"View", "Ctrl+Q", "end"},
    {"Scene", "Ctrl+O", "open another scene or model; or drop its file on the window"},
    {"Scene", "U", "update the light now"},
    {"Scene", "P", "play the file's animation, pause"},
    {"Scene", "F5", "read the file again; also when it has been saved"},
    {"Scene", "F12", "save the picture: PNG as shown, EXR with its light"},
});

std::optional<Command> ofText(char32_t character) {
    switch (character) {
    case U'?':
        return Command{Action::help};
    case U'[':
        return Command{Action::darkerView};
    case U']':
        return Command{Action::brighterView};
    case U'\\':
        return Command{Action::autoExposure};
    case U'-':
        return Command{Action::dimmer};
    case U'+':
    case U'=': // the same key without Shift on many keyboards
        return Command{Action::brighter};
    default:
        return std::nullopt;
    }
}

std::optional<Command> ofLetter(char letter, Modifiers modifiers) {
    const bool shift = modifiers.shift;
    if (modifiers.control) {
        switch (letter) {
        case 'D':
            return Command{Action::duplicate};
        case 'O':
            return Command{Action::open};
        case 'Q':
            return Command{Action::quit};
        case 'Z':
            return Command{shift ? Action::redo : Action::undo};
        case 'Y':
            return Command{Action::redo};
        default:
            return std::nullopt;
        }
    }
    switch (letter) {
    case 'G':
        return Command{Action::gravity};
    case 'C':
        return Command{Action::collision};
    case 'F':
        return Command{Action::frame};
    case 'H':
        return Command{shift ? Action::showHidden : Action::hide};
    case 'T':
        return Command{Action::nextTone};
    case 'R':
        return Command{shift ? Action::turnRight : Action::turnLeft};
    case 'L':
        return Command{Action::switchLight};
    case 'N':
        return Command{Action::panels};
    case 'O':
        return Command{shift ? Action::previousOverlay : Action::nextOverlay};
    case 'P':
        return Command{Action::play};
    case 'U':
        return Command{Action::update};
    default:
        return std::nullopt;
    }
}

/// Keys that go on while they are held.
std::optional<Command> ofHeldKey(Key pressed, bool shift) {
    const auto nudge = [&](NudgeDirection way) { return Command{Action::nudge, int(way), shift}; };
    switch (pressed) {
    case Key::left:
        return nudge(NudgeDirection::left);
    case Key::right:
        return nudge(NudgeDirection::right);
    case Key::up:
        return nudge(NudgeDirection::farther);
    case Key::down:
        return nudge(NudgeDirection::nearer);
    case Key::pageUp:
        return nudge(NudgeDirection::up);
    case Key::pageDown:
        return nudge(NudgeDirection::down);
    default:
        return std::nullopt;
    }
}

std::optional<Command> ofKey(Key pressed) {
    if (pressed >= key('1') && pressed <= key('9'))
        return Command{Action::bookmark, int(pressed) - int(Key::zero)};
    switch (pressed) {
    case Key::escape:
        return Command{Action::cancel};
    case Key::remove:
        return Command{Action::remove};
    case Key::tab:
        return Command{Action::nextMode};
    case Key::home:
        return Command{Action::home};
    case Key::f1:
        return Command{Action::help};
    case Key::f5:
        return Command{Action::reload};
    case Key::f12:
        return Command{Action::save};
    case Key::f11:
        return Command{Action::fullScreen};
    default:
        return std::nullopt;
    }
}

} // namespace

std::span<const HelpLine> helpLines() {
    return kHelp;
}

std::optional<Command> commandOf(const InputEvent& event) {
    if (const auto* text = std::get_if<TextEvent>(&event)) return ofText(text->character);
    const auto* stroke = std::get_if<KeyEvent>(&event);
    if (!stroke || !stroke->down || stroke->modifiers.alt) return std::nullopt;
    if (!stroke->modifiers.control)
        if (const auto command = ofHeldKey(stroke->key, stroke->modifiers.shift)) return command;
    if (stroke->repeat && !stroke->modifiers.control) return std::nullopt;
    if (const auto command = ofLetter(stroke->letter, stroke->modifiers)) return command;
    return stroke->modifiers.control ? std::nullopt : ofKey(stroke->key);
}

} // namespace penumbra
