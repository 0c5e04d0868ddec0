// A scene that is walked through: everything that input changes, and nothing of OpenGL.
#pragma once

#include "viewer/input/CameraRig.h"
#include "viewer/input/Drag.h"
#include "viewer/input/MotionControls.h"
#include "viewer/input/SceneEdit.h"
#include "viewer/input/SceneLoader.h"
#include "viewer/input/Selection.h"
#include "viewer/input/Shortcuts.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

namespace penumbra {

/// A loaded scene and the person in it.
class Walkthrough {
public:
    explicit Walkthrough(ReadyScene ready);

    const LoadedScene& loaded() const { return loaded_; }
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
    /// Goes to a camera at once. \param file for the error message \throws Error there is none
    void goTo(const std::string& cameraPath, const std::string& file);
    /// Lets time pass.
    void advance(double seconds);
    double time() const { return time_; } ///< that has passed [s]

    /// What the pointer is on, in a picture of that size [pixel].
    std::optional<Touch> pointedAt(glm::ivec2 picture) const;
    const std::optional<Selection>& selection() const { return selection_; }
    void select(std::optional<Selection> selection) { selection_ = std::move(selection); }
    /// The thing that somebody has taken hold of, from before it moves.
    std::shared_ptr<const Transform> inHand() const { return held_ ? held_->node : nullptr; }

    const EditHistory& history() const { return history_; }
    /// Makes an edit of the scene, such that it can be taken back.
    void make(const EditHistory::Step& step);
    /// Makes the selected lights, or all lights, so many stops brighter.
    void brighten(double stops);
    /// Something else has edited the scene graph: a played animation.
    void followScene();

    /// Rises with every edit of the scene.
    std::uint64_t revision() const { return revision_; }
    /// Whether things go on moving without input.
    bool moving() const;
    /// Whether the pointer is to be hidden and let move without end.
    bool wantsPointer() const { return pointerHeld_; }

private:
    /// What the left button took hold of.
    struct Held {
        std::shared_ptr<Transform> node;
        ObjectId object;
        glm::dmat4 before{1.0}; ///< the node's matrix
        Drag drag;
        glm::dvec2 from{0.0}; ///< where the button went down [pixel]
        bool moving = false;  ///< false: not far enough from there yet, it may be a click
    };

    SightLine sightAt(glm::dvec2 position, glm::ivec2 picture) const;
    bool performOnCamera(const Command& command);
    void performOnScene(const Command& command);
    void performOnSelection(const Command& command);
    void press(const ButtonEvent& button, glm::ivec2 picture);
    void release(const ButtonEvent& button);
    bool takeHold(const ButtonEvent& button, glm::ivec2 picture);
    bool isAround(ObjectId object) const;
    void dragTo(const MoveEvent& move, glm::ivec2 picture);
    void letGo(bool keep);
    void place(const Selection& selection, const glm::dmat4& toWorld);
    void nudge(NudgeDirection way, double metres);
    void turnSelected(double angle);
    void switchLights();
    void removeSelected(bool hides);
    void showHidden();
    void duplicateSelected();
    glm::dvec3 besideCamera() const;
    void changed();
    void followSelection();

    LoadedScene loaded_;
    PlacedScene placed_;
    std::unique_ptr<SceneRays> rays_;
    CameraRig rig_;
    MotionControls controls_;
    std::vector<Bookmark> bookmarks_;
    std::optional<MouseButton> gestureButton_; ///< ends the gesture when it is let go
    bool pointerHeld_ = false;
    std::optional<Selection> selection_;
    std::optional<Held> held_;
    EditHistory history_;
    std::unordered_map<const Light*, Rgb> switchedOff_; ///< what a light was before [nit]
    double time_ = 0;
    std::uint64_t revision_ = 1;
};

} // namespace penumbra
