// What hands do, as what the camera is asked for.
#pragma once

#include "viewer/input/CameraMotion.h"
#include "viewer/input/Input.h"

#include <bitset>
#include <cstddef>

namespace penumbra {

/// Keys and mouse movements, gathered to the MotionInput of a frame. Movement keys count by their
/// position on the keyboard, as games have it:
///
///     W A S D   ahead, left, back, right      E Q   up, down       Shift   run
class MotionControls {
public:
    enum class Gesture { none, look, orbit, pan, zoom };

    /// What the pointer's movements do until end().
    void begin(Gesture gesture) { gesture_ = gesture; }
    void end() { gesture_ = Gesture::none; }
    Gesture gesture() const { return gesture_; }

    /// \param pictureHeight [pixel]
    void take(const InputEvent& event, int pictureHeight);
    /// Lets go of all keys and gestures.
    void release();

    /// What came together since the last call.
    MotionInput takeMotion();

    const InputState& state() const { return state_; }
    /// Whether a letter is held to move by: not since it was part of a shortcut, such as Ctrl+D,
    /// of which the Ctrl may be let go first.
    bool moves(char letter) const {
        return state_.held(key(letter)) && !shortcuts_.test(std::size_t(letter));
    }

    double sensitivity = 1; ///< of looking around: 1 turns 0.1 degrees a pixel

private:
    InputState state_;
    Gesture gesture_ = Gesture::none;
    MotionInput gathered_;
    std::bitset<128> shortcuts_; ///< letters that were pressed with Ctrl or Alt, and are held
};

} // namespace penumbra
