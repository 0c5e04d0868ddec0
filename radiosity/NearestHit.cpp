// The sides of a ray on which edges pass, by Plücker coordinates: K. Shoemake, "Plücker coordinate
// tutorial", Ray Tracing News 11(1), 1998.
#include "radiosity/NearestHit.h"

#include <cmath>
#include <numbers>
#include <utility>

namespace penumbra {

bool NearestHit::take(std::span<const glm::vec3, 3> corners, const RayHit& hit) {
    const glm::dvec3 a = glm::dvec3(corners[0]) - origin_, b = glm::dvec3(corners[1]) - origin_,
                     c = glm::dvec3(corners[2]) - origin_;
    // Those of an edge that is taken the other way round differ in their sign alone.
    const double sideA = glm::dot(glm::cross(b, c), direction_);
    const double sideB = glm::dot(glm::cross(c, a), direction_);
    const double sideC = glm::dot(glm::cross(a, b), direction_);
    const bool back = sideA >= 0 && sideB >= 0 && sideC >= 0;
    const bool front = sideA <= 0 && sideB <= 0 && sideC <= 0;
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    if (frontOnly_ && glm::dot(direction_, normal) >= 0) return false;
    if (back == front) { // it passes beside the triangle, or along it
        if (hit.distance < doubt_.distance) doubt_ = hit, middle_ = (a + b + c) / 3.0;
        return false;
    }
    const double distance = glm::dot(a, normal) / glm::dot(direction_, normal);
    if (!(distance >= 0) || distance > distance_) return false;
    if (distance == distance_ &&
        std::pair(hit_.object.value, hit_.triangle) <= std::pair(hit.object.value, hit.triangle))
        return false;
    const double sum = sideA + sideB + sideC;
    distance_ = distance;
    hit_ = hit;
    hit_.distance = float(distance);
    hit_.u = float(sideB / sum);
    hit_.v = float(sideC / sum);
    return true;
}

glm::vec3 NearestHit::beside(float hair, int i) const {
    const glm::dvec3 ray = glm::normalize(direction_);
    const glm::dvec3 axis = std::abs(ray.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 u = glm::normalize(glm::cross(axis, ray)), v = glm::cross(ray, u);
    const double turn = 2 * std::numbers::pi * (i + 0.3) / kAround; // seldom along an edge
    const double share = double(hair) / double(doubt_.distance);
    return direction_ + share * (std::cos(turn) * u + std::sin(turn) * v);
}

glm::vec3 NearestHit::aside(float hair) const {
    const glm::dvec3 at = double(doubt_.distance) * direction_;
    const glm::dvec3 ray = direction_ / glm::length(direction_);
    const glm::dvec3 away = (at - middle_) - glm::dot(at - middle_, ray) * ray;
    const double far = glm::length(away);
    if (far == 0) return direction_;
    const glm::dvec3 to = at + double(hair) / far * away;
    return glm::length(direction_) / glm::length(to) * to;
}

} // namespace penumbra
