// What people change in a scene, so that it can be taken back.
#pragma once

#include "scenegraph/Light.h"
#include "scenegraph/Material.h"
#include "scenegraph/Transform.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <memory>
#include <variant>
#include <vector>

namespace penumbra {

/// A thing is moved or turned.
struct MoveEdit {
    std::shared_ptr<Transform> node;
    glm::dmat4 before{1.0}, after{1.0}; ///< Transform::matrix()
};
/// A light is dimmed, switched or recoloured.
struct LightEdit {
    std::shared_ptr<Light> light;
    Rgb before, after; ///< [nit]
};
/// A surface is repainted, or, if it emits, dimmed or recoloured.
struct PaintEdit {
    std::shared_ptr<Material> material;
    struct Paint {
        Rgb reflectance;
        Rgb emission; ///< [nit]
        friend bool operator==(const Paint&, const Paint&) = default;
    } before, after;
};
/// A thing comes or goes: it is a child of its parent, or not.
struct PresenceEdit {
    std::shared_ptr<Group> parent;
    NodePtr node;
    std::size_t place = 0; ///< among the parent's children, where it is or was
    bool before = false, after = false;
    bool hides = false; ///< it goes to be shown again: a layer says that it is invisible
};
using SceneEdit = std::variant<MoveEdit, LightEdit, PaintEdit, PresenceEdit>;

/// Brings the scene to the state after the edit, or back to that before.
void apply(const SceneEdit& edit);
void takeBack(const SceneEdit& edit);
/// Whether it makes any difference.
bool changes(const SceneEdit& edit);

/// The edits of a session, step by step, with the way back and forth. A step is what people do at
/// once: several edits if it was done to several things.
class EditHistory {
public:
    using Step = std::vector<SceneEdit>;

    /// Makes a step. One that follows another of the same kind to the same things within
    /// kMergeSeconds becomes one with it: what a held key or a slider does is taken back at once.
    /// \param time of the session [s]
    void make(const Step& step, double time);
    /// Notes a step that has been made already, bit by bit, such as a drag. It stands alone.
    void note(const Step& step);

    /// Whether there was something to take back, or to make again.
    bool undo();
    bool redo();
    std::size_t undoable() const { return made_; }
    /// Whether the scene is another one by these edits.
    bool edited() const;
    /// How things went that are hidden now, the last one first.
    std::vector<PresenceEdit> hidden() const;
    std::size_t redoable() const { return steps_.size() - made_; }

    static constexpr double kMergeSeconds = 0.7;

private:
    static constexpr double kNever = -1e9;

    bool merge(const Step& step, double time);
    void push(const Step& step);

    std::vector<Step> steps_;
    std::size_t made_ = 0; ///< the first so many are in the scene
    double last_ = kNever; ///< time of the last step, if others may merge with it [s]
};

} // namespace penumbra
