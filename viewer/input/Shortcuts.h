// Which key does what: the one list that both the keyboard and the help are read from.
#pragma once

#include "viewer/input/Input.h"

#include <optional>
#include <span>

namespace penumbra {

/// What a single key stroke asks for.
enum class Action {
    help,
    panels,
    quit,
    fullScreen,
    nextMode,
    gravity,
    collision,
    bookmark, ///< with its number
    home,
    frame,
    cancel,
    undo,
    redo,
    nudge, ///< with its NudgeDirection as number
    turnLeft,
    turnRight,
    dimmer,
    brighter,
    switchLight,
    remove,
    hide,
    showHidden,
    duplicate,
    brighterView,
    darkerView,
    autoExposure,
    nextTone,
    nextOverlay,
    previousOverlay,
    update,
    play,
    save,
    reload,
    open,
};

/// A line of the help.
struct HelpLine {
    const char* group;
    const char* keys;
    const char* text;
};
std::span<const HelpLine> helpLines();

/// As seen by the camera.
enum class NudgeDirection { left, right, nearer, farther, up, down };

struct Command {
    Action action;
    int number = 0;    ///< of a bookmark, from 1; see Action
    bool more = false; ///< Shift: in larger steps
};

/// The command of a key stroke, if it is one. Letters count as the keyboard's layout has them;
/// signs such as '?' come as text.
std::optional<Command> commandOf(const InputEvent& event);

} // namespace penumbra
