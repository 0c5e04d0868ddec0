// Things that follow the pointer.
#pragma once

#include "radiosity/query/SceneRays.h"
#include "viewer/input/CameraPose.h"

#include <glm/glm.hpp>

#include <optional>

namespace penumbra {

/// A line of sight.
struct SightLine {
    glm::dvec3 origin{0.0};
    glm::dvec3 direction{0.0, 1.0, 0.0}; ///< unit
};

/// What a thing rests on, which is what the plane it is dragged in follows.
enum class Support { floor, wall, ceiling, none };
struct SupportPlane {
    Support support = Support::none;
    glm::dvec3 normal{0.0}; ///< unit, of the plane to drag in
};

/// What an object rests on: what is below it within a few centimetres, else above it (it hangs),
/// else beside it (it hangs on a wall). With nothing near, the level plane.
SupportPlane supportOf(const SceneRays& rays, ObjectId object, const Compass& compass);

/// A thing in the hand: where it goes as the pointer moves.
///
/// The point that was taken hold of stays under the pointer, in the plane of what the thing rests
/// on; where that is seen nearly edge-on, it follows the pointer sideways. Lifting moves it up and
/// down only, turning about the upright line through the point. A change of mode begins anew where
/// the thing is, so that nothing jumps.
class Drag {
public:
    enum class Mode { slide, lift, turn };

    /// \param hold       where it was touched [m, world]
    /// \param toWorld    the frame of the thing
    Drag(glm::dvec3 hold, const glm::dmat4& toWorld, const SupportPlane& plane,
         const Compass& compass);

    /// The frame of the thing with the pointer now on this line of sight.
    /// \param share how far the pointer has moved to the right since the last call, in heights of
    ///              the picture: what turning goes by
    glm::dmat4 moved(const SightLine& sight, Mode mode, double share);

    const glm::dmat4& toWorld() const { return toWorld_; }

    static constexpr double kFarthest = 100; ///< from the eye: nothing is dragged beyond [m]

private:
    void anchor(const SightLine& sight, Mode mode);
    glm::dvec3 normalFor(const SightLine& sight, Mode mode) const;
    std::optional<glm::dvec3> meet(const SightLine& sight) const;

    Compass compass_;
    SupportPlane support_;
    glm::dmat4 toWorld_;
    glm::dvec3 hold_;           ///< where the hand is now
    std::optional<Mode> mode_;  ///< none: not moved yet
    glm::dvec3 normal_{0.0};    ///< of the plane the pointer is followed in
    glm::dvec3 planeHold_{0.0}; ///< where the plane is
    glm::dvec3 offset_{0.0};    ///< from where the pointer met the plane to the hand
};

/// A frame moved by a translation; its axes keep every bit.
glm::dmat4 shifted(glm::dmat4 frame, glm::dvec3 by);
/// A frame turned about a line. \param axis unit \param angle [rad]
glm::dmat4 turned(const glm::dmat4& frame, glm::dvec3 point, glm::dvec3 axis, double angle);

} // namespace penumbra
