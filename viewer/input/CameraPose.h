// Where somebody stands and looks, without roll.
#pragma once

#include "scenegraph/Scene.h"

#include <glm/glm.hpp>

namespace penumbra {

/// The directions of a scene: right-handed, `up` as the scene has it, east and north level.
struct Compass {
    explicit Compass(UpAxis axis)
        : up(axis == UpAxis::z ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0)), east(1, 0, 0),
          north(glm::cross(up, east)) {}

    glm::dvec3 up, east, north;
};

/// A view without roll.
struct CameraPose {
    glm::dvec3 eye{0.0}; ///< [m, world]
    double heading = 0;  ///< from north towards east [rad]
    double pitch = 0;    ///< up from level [rad], at most kSteepest either way

    static constexpr double kSteepest = 1.5533; ///< 89 degrees: straight up has no heading

    /// Unit; the way it looks, and the level direction to its right.
    glm::dvec3 forward(const Compass& compass) const;
    glm::dvec3 right(const Compass& compass) const;
    glm::dmat4 toWorld(const Compass& compass) const; ///< of a camera that looks along -Z, +Y up

    friend bool operator==(const CameraPose&, const CameraPose&) = default;
};

/// The pose of a camera, its roll taken out.
CameraPose poseOf(const glm::dmat4& cameraToWorld, const Compass& compass);

/// The pose a share `t` in [0, 1] of the way from one to another, the shorter way round.
CameraPose between(const CameraPose& from, const CameraPose& to, double t);

} // namespace penumbra
