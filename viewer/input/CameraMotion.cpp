#include "viewer/input/CameraMotion.h"

#include <algorithm>
#include <cmath>

namespace penumbra {

namespace {

constexpr double kGravity = 9.81;    // [m/s^2]
constexpr double kTerminal = 20;     // nobody falls faster [m/s]
constexpr double kStepHeight = 0.45; // what a walker steps over; walls are felt for above it [m]
constexpr double kStepSeconds = 0.1; // time constant of stepping up
constexpr double kFloorReach = 1000; // how far down a floor is searched for [m]

glm::dvec3 rotated(glm::dvec3 v, glm::dvec3 axis, double angle) { // Rodrigues' formula
    return v * std::cos(angle) + glm::cross(axis, v) * std::sin(angle) +
           axis * (glm::dot(axis, v) * (1 - std::cos(angle)));
}

void turn(CameraPose& pose, glm::dvec2 by) {
    pose.heading += by.x;
    pose.pitch = std::clamp(pose.pitch + by.y, -CameraPose::kSteepest, CameraPose::kSteepest);
}

/// The velocity that the hands ask for [m/s].
glm::dvec3 wanted(const CameraPose& pose, TravelMode mode, const MotionInput& input,
                  const TravelOptions& options, const Compass& compass) {
    const glm::dvec3 right = pose.right(compass);
    const bool level = mode == TravelMode::walk;
    const glm::dvec3 ahead = level ? glm::cross(compass.up, right) : pose.forward(compass);
    const double rise = level && options.gravity ? 0.0 : input.move.z;
    glm::dvec3 direction = input.move.x * right + input.move.y * ahead + rise * compass.up;
    const double length = glm::length(direction);
    if (length > 1) direction /= length; // not faster along the diagonal
    return direction * (options.speed * (input.run ? options.runFactor : 1.0));
}

/// A step that ends before walls and slides along them; felt for at the heights of eyes and knees.
glm::dvec3 stopped(glm::dvec3 step, const CameraPose& pose, const TravelOptions& options,
                   const Compass& compass, const Surroundings& surroundings) {
    const double knee = std::max(0.0, options.eyeHeight - kStepHeight);
    for (int bounce = 0; bounce < 3; ++bounce) { // a corner has two walls
        const double length = glm::length(step);
        if (!(length > 0)) return step;
        std::optional<Surroundings::Obstacle> nearest;
        for (const double below : {0.0, knee}) {
            const auto wall = surroundings.ahead(pose.eye - below * compass.up, step / length,
                                                 length + 2 * options.girth);
            if (wall && (!nearest || wall->distance < nearest->distance)) nearest = wall;
        }
        if (!nearest) return step;
        // The distance of the plane, not along the way: grazing a wall one comes just as near.
        const double towards = -glm::dot(step, nearest->normal);
        const double room = nearest->distance * towards / length - options.girth;
        if (towards <= std::max(room, 0.0)) return step;
        step += nearest->normal * (towards - std::max(room, 0.0));
    }
    return glm::dvec3(0);
}

/// Puts the eyes at their height above the floor, in the time that takes.
void stand(Travel& state, double seconds, const TravelOptions& options, const Compass& compass,
           const Surroundings& surroundings) {
    const auto floor = surroundings.ahead(state.pose.eye, -compass.up, kFloorReach);
    if (!floor) { // nothing to fall on: stay
        state.fall = 0;
        return;
    }
    const double above = floor->distance - options.eyeHeight;
    if (above <= 0) {
        state.fall = 0;
        state.pose.eye -= above * (1 - std::exp(-seconds / kStepSeconds)) * compass.up;
        return;
    }
    const double drop = std::min(above, state.fall * seconds + kGravity * seconds * seconds / 2);
    state.pose.eye -= drop * compass.up;
    state.fall = drop < above ? std::min(state.fall + kGravity * seconds, kTerminal) : 0.0;
}

} // namespace

bool MotionInput::idle() const {
    return move == glm::dvec3(0) && turn == glm::dvec2(0) && orbit == glm::dvec2(0) &&
           pan == glm::dvec2(0) && dolly == 0;
}

Travel travelled(Travel state, TravelMode mode, const MotionInput& input, double seconds,
                 const TravelOptions& options, const Compass& compass,
                 const Surroundings& surroundings) {
    turn(state.pose, input.turn);
    const double decay = std::exp(-seconds / Travel::kSmoothing);
    const glm::dvec3 target = wanted(state.pose, mode, input, options, compass);
    // v' = (target - v) / tau, integrated
    glm::dvec3 step =
        target * seconds + (state.velocity - target) * (Travel::kSmoothing * (1 - decay));
    state.velocity = target + (state.velocity - target) * decay;

    state.dollyLeft += input.dolly * options.dollyStep;
    glm::dvec3 ahead = state.pose.forward(compass);
    if (mode == TravelMode::walk && options.gravity)
        ahead = glm::cross(compass.up, state.pose.right(compass));
    step += ahead * (state.dollyLeft * (1 - decay));
    state.dollyLeft *= decay;

    if (mode == TravelMode::walk && options.collision)
        step = stopped(step, state.pose, options, compass, surroundings);
    state.pose.eye += step;
    if (mode == TravelMode::walk && options.gravity)
        stand(state, seconds, options, compass, surroundings);
    else
        state.fall = 0;
    return state;
}

Orbit orbited(Orbit state, const MotionInput& input, double seconds, double viewTangent,
              const Compass& compass) {
    CameraPose& pose = state.pose;
    turn(pose, input.turn);
    const double before = pose.pitch;
    glm::dvec3 arm = pose.eye - state.centre;
    arm = rotated(arm, compass.up, -input.orbit.x); // headings run the other way round
    turn(pose, input.orbit);
    arm = rotated(arm, pose.right(compass), pose.pitch - before);

    state.zoomLeft -= input.dolly * Orbit::kZoomStep;
    const double share = state.zoomLeft * (1 - std::exp(-seconds / Travel::kSmoothing));
    state.zoomLeft -= share;
    const double length = glm::length(arm);
    if (length > 0) arm *= std::max(std::exp(share), std::min(1.0, Orbit::kNearest / length));

    const glm::dvec3 right = pose.right(compass);
    const glm::dvec3 viewUp = glm::cross(right, pose.forward(compass));
    const double width = 2 * viewTangent * glm::length(arm);
    state.centre += width * (input.pan.x * right + input.pan.y * viewUp);
    pose.eye = state.centre + arm;
    return state;
}

} // namespace penumbra
