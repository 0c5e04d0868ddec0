// Walking, flying and orbiting: pure functions of what hands do and how much time passes.
#pragma once

#include "scenegraph/Surroundings.h"
#include "viewer/input/CameraPose.h"

#include <glm/glm.hpp>

#include <optional>

namespace penumbra {

/// What hands ask of the camera, for a stretch of time.
struct MotionInput {
    glm::dvec3 move{0.0}; ///< to the right, forward, up: how much of the full speed, each -1 to 1
    bool run = false;
    glm::dvec2 turn{0.0};  ///< heading, pitch [rad]
    glm::dvec2 orbit{0.0}; ///< the same, around the orbit's centre
    glm::dvec2 pan{0.0};   ///< to the right, up; in lengths of the view at the orbit's centre
    double dolly = 0;      ///< notches of the wheel forward

    bool idle() const;
};

struct TravelOptions {
    double speed = 1.6;     ///< [m/s]
    double runFactor = 2.5; ///< how much faster running is
    bool gravity = true;    ///< of walking
    bool collision = false; ///< walls stop a walker
    double eyeHeight = 1.65;
    double girth = 0.25;     ///< how near a walker's eyes come to walls [m]
    double dollyStep = 0.35; ///< for a notch of the wheel [m]
};

/// A camera on its way. Velocity and what the wheel asked for follow exponentially, and are
/// integrated in closed form: ten frames come to where one frame of the same time comes to.
struct Travel {
    CameraPose pose;
    glm::dvec3 velocity{0.0}; ///< [m/s, world]
    double dollyLeft = 0;     ///< what the wheel asked for and has not been given yet [m]
    double fall = 0;          ///< how fast a walker falls [m/s]

    static constexpr double kSmoothing = 0.08; ///< time constant [s]
};

enum class TravelMode { walk, fly };

/// Where the camera is after `seconds`. Walking is level, whichever way one looks, and, with
/// gravity, keeps the eyes at their height above the floor: down by falling, up as on stairs.
Travel travelled(Travel state, TravelMode mode, const MotionInput& input, double seconds,
                 const TravelOptions& options, const Compass& compass,
                 const Surroundings& surroundings);

/// A camera that circles around a point. The point stays where it is in the view.
struct Orbit {
    CameraPose pose;
    glm::dvec3 centre{0.0}; ///< [m, world]
    double zoomLeft = 0;    ///< logarithm of the distance that is still to be gone

    static constexpr double kZoomStep = 0.12; ///< of a notch of the wheel
    static constexpr double kNearest = 0.02;  ///< [m]
};

/// \param viewTangent half the view's width at distance 1: what panning goes by
Orbit orbited(Orbit state, const MotionInput& input, double seconds, double viewTangent,
              const Compass& compass);

} // namespace penumbra
