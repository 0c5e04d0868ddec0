#include "viewer/input/Drag.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace penumbra {

namespace {

constexpr double kTouching = 0.05; // what is nearer than this is rested on [m]
constexpr double kEdgeOn = 0.1;    // sine of the angle below which a plane can't be dragged in
constexpr double kTurn = 2 * std::numbers::pi; // for the picture's height to the side [rad]

} // namespace

SupportPlane supportOf(const SceneRays& rays, ObjectId object, const Compass& compass) {
    const Bounds box = rays.bounds(object);
    const glm::dvec3 centre(box.centre()), half = 0.5 * glm::dvec3(box.size());
    const auto near = [&](glm::dvec3 way) {
        const double reach = glm::dot(glm::abs(way), half) + kTouching;
        return rays.touch(centre, way, reach, object).has_value();
    };
    if (near(-compass.up)) return {Support::floor, compass.up};
    if (near(compass.up)) return {Support::ceiling, compass.up};
    for (const glm::dvec3 way : {compass.east, compass.north, -compass.east, -compass.north})
        if (near(way)) return {Support::wall, -way};
    return {Support::none, compass.up};
}

glm::dmat4 shifted(glm::dmat4 frame, glm::dvec3 by) {
    frame[3] += glm::dvec4(by, 0);
    return frame;
}

glm::dmat4 turned(const glm::dmat4& frame, glm::dvec3 point, glm::dvec3 axis, double angle) {
    const glm::dmat4 turn = glm::rotate(glm::dmat4(1.0), angle, axis);
    glm::dmat4 result = turn * frame;
    result[3] =
        glm::dvec4(point + glm::dvec3(turn * glm::dvec4(glm::dvec3(frame[3]) - point, 0)), 1);
    return result;
}

Drag::Drag(glm::dvec3 hold, const glm::dmat4& toWorld, const SupportPlane& plane,
           const Compass& compass)
    : compass_(compass), support_(plane), toWorld_(toWorld), hold_(hold) {}

glm::dvec3 Drag::normalFor(const SightLine& sight, Mode mode) const {
    const bool upright =
        mode == Mode::lift || std::abs(glm::dot(sight.direction, support_.normal)) < kEdgeOn;
    if (!upright) return support_.normal;
    const glm::dvec3 level = sight.direction - compass_.up * glm::dot(sight.direction, compass_.up);
    const double length = glm::length(level);
    return length > 1e-6 ? -level / length : compass_.north; // straight down: any will do
}

std::optional<glm::dvec3> Drag::meet(const SightLine& sight) const {
    const double towards = glm::dot(sight.direction, normal_);
    const double distance = glm::dot(planeHold_ - sight.origin, normal_) / towards;
    if (!(distance > 0) || !(distance < kFarthest)) return std::nullopt;
    return sight.origin + distance * sight.direction;
}

void Drag::anchor(const SightLine& sight, Mode mode) {
    mode_ = mode;
    normal_ = normalFor(sight, mode);
    planeHold_ = hold_;
    const auto met = meet(sight);
    offset_ = met ? hold_ - *met : glm::dvec3(0);
}

glm::dmat4 Drag::moved(const SightLine& sight, Mode mode, double share) {
    if (mode_ != mode) {
        anchor(sight, mode);
        return toWorld_;
    }
    if (mode == Mode::turn) {
        toWorld_ = turned(toWorld_, hold_, compass_.up, kTurn * share);
        return toWorld_;
    }
    const auto met = meet(sight);
    if (!met) return toWorld_; // above the horizon: it stays where it is
    glm::dvec3 by = *met + offset_ - hold_;
    if (mode == Mode::lift)
        by = compass_.up * glm::dot(by, compass_.up);
    else // also where it is followed in the upright plane: it stays on what it rests on
        by -= support_.normal * glm::dot(by, support_.normal);
    hold_ += by;
    toWorld_ = shifted(toWorld_, by);
    return toWorld_;
}

} // namespace penumbra
