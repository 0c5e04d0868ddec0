// A scene that is walked through: everything that input changes, and nothing of OpenGL.
#pragma once

#include "viewer/CameraRig.h"
#include "viewer/MotionControls.h"
#include "viewer/SceneLoader.h"
#include "viewer/Shortcuts.h"

#include <glm/glm.hpp>

#include <memory>
#include <optional>
#include <vector>

namespace penumbra {

/// A loaded scene and the person in it.
class Walkthrough {
public:
    explicit Walkthrough(ReadyScene ready);

    const Scene& scene() const { return *loaded_.scene; }
    const PlacedScene& placed() const { return placed_; }
    const SceneRays& rays() const { return *rays_; }
    CameraRig& rig() { return rig_; }
    const CameraRig& rig() const { return rig_; }
    MotionControls& controls() { return controls_; }
    const std::vector<Bookmark>& bookmarks() const { return bookmarks_; }

    /// Takes in what hands did over a picture of that size [pixel].
    void take(const InputEvent& event, glm::ivec2 picture);
    /// Carries out a command, if it is one for the camera or the scene.
    void perform(const Command& command);
    /// Lets time pass.
    void advance(double seconds);

    /// Whether things go on moving without input.
    bool moving() const;
    /// Whether the pointer is to be hidden and let move without end.
    bool wantsPointer() const { return pointerHeld_; }

private:
    struct Ray {
        glm::dvec3 origin, direction; ///< direction: unit
    };
    Ray rayAt(glm::dvec2 position, glm::ivec2 picture) const;
    void press(const ButtonEvent& button, glm::ivec2 picture);
    void centreOrbitAt(glm::dvec2 position, glm::ivec2 picture);

    LoadedScene loaded_;
    PlacedScene placed_;
    std::unique_ptr<SceneRays> rays_;
    CameraRig rig_;
    MotionControls controls_;
    std::vector<Bookmark> bookmarks_;
    std::optional<MouseButton> gestureButton_; ///< ends the gesture when it is let go
    bool pointerHeld_ = false;
};

} // namespace penumbra
