#include "viewer/input/CameraPose.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace penumbra {

glm::dvec3 CameraPose::forward(const Compass& compass) const {
    const glm::dvec3 level = std::sin(heading) * compass.east + std::cos(heading) * compass.north;
    return std::cos(pitch) * level + std::sin(pitch) * compass.up;
}

glm::dvec3 CameraPose::right(const Compass& compass) const {
    return std::cos(heading) * compass.east - std::sin(heading) * compass.north;
}

glm::dmat4 CameraPose::toWorld(const Compass& compass) const {
    const glm::dvec3 back = -forward(compass), x = right(compass);
    return {glm::dvec4(x, 0), glm::dvec4(glm::cross(back, x), 0), glm::dvec4(back, 0),
            glm::dvec4(eye, 1)};
}

CameraPose poseOf(const glm::dmat4& cameraToWorld, const Compass& compass) {
    const glm::dvec3 forward = glm::normalize(-glm::dvec3(cameraToWorld[2]));
    const double rise = std::clamp(glm::dot(forward, compass.up), -1.0, 1.0);
    // a camera that looks straight down has its heading in its own up, or if up, in its down
    const bool level = std::abs(rise) < 0.9999;
    const glm::dvec3 ahead =
        level ? forward : (rise > 0 ? -1.0 : 1.0) * glm::dvec3(cameraToWorld[1]);
    CameraPose pose;
    pose.eye = glm::dvec3(cameraToWorld[3]);
    pose.heading = std::atan2(glm::dot(ahead, compass.east), glm::dot(ahead, compass.north));
    pose.pitch = std::clamp(std::asin(rise), -CameraPose::kSteepest, CameraPose::kSteepest);
    return pose;
}

CameraPose between(const CameraPose& from, const CameraPose& to, double t) {
    CameraPose pose;
    pose.eye = glm::mix(from.eye, to.eye, t);
    pose.heading =
        from.heading + t * std::remainder(to.heading - from.heading, 2 * std::numbers::pi);
    pose.pitch = from.pitch + t * (to.pitch - from.pitch);
    return pose;
}

} // namespace penumbra
