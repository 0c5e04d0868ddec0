#include "viewer/Shortcuts.h"

#include <array>

namespace penumbra {

namespace {

constexpr std::array kHelp = std::to_array<HelpLine>({
    {"Move", "W A S D", "ahead, left, back, right (Shift: run)"},
    {"Move", "E Q", "up, down (flying, or without gravity)"},
    {"Move", "right mouse button", "look around; also the left one on what can't be moved"},
    {"Move", "mouse wheel", "forward, back; sideways: turn"},
    {"Move", "middle button, Alt+left", "circle around what is under the pointer"},
    {"Move", "Shift+middle, Alt+middle", "shift the view (Alt+right: nearer, farther)"},
    {"Move", "Tab", "walk, fly, orbit"},
    {"Move", "G", "gravity on, off"},
    {"Move", "C", "walls stop you, or not"},
    {"Move", "1 ... 9", "the cameras of the file"},
    {"Move", "Home", "the whole scene"},
    {"Move", "F", "what is selected"},
    {"View", "[  ]", "darker, brighter (exposure)"},
    {"View", "\\", "exposure by itself, or fixed"},
    {"View", "T", "next tone curve: AgX, ACES, sRGB"},
    {"View", "F11", "full screen"},
    {"View", "?", "this help"},
    {"View", "Ctrl+Q", "end"},
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
    default:
        return std::nullopt;
    }
}

std::optional<Command> ofLetter(char letter, bool control) {
    if (control) return letter == 'Q' ? std::optional(Command{Action::quit}) : std::nullopt;
    switch (letter) {
    case 'G':
        return Command{Action::gravity};
    case 'C':
        return Command{Action::collision};
    case 'F':
        return Command{Action::frame};
    case 'T':
        return Command{Action::nextTone};
    default:
        return std::nullopt;
    }
}

std::optional<Command> ofKey(Key pressed) {
    if (pressed >= key('1') && pressed <= key('9'))
        return Command{Action::bookmark, int(pressed) - int(Key::zero)};
    switch (pressed) {
    case Key::tab:
        return Command{Action::nextMode};
    case Key::home:
        return Command{Action::home};
    case Key::f1:
        return Command{Action::help};
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
    if (!stroke || !stroke->down || stroke->repeat || stroke->modifiers.alt) return std::nullopt;
    if (const auto command = ofLetter(stroke->letter, stroke->modifiers.control)) return command;
    return stroke->modifiers.control ? std::nullopt : ofKey(stroke->key);
}

} // namespace penumbra
