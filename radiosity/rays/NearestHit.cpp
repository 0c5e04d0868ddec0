// The sides of a ray on which edges pass, by Plücker coordinates: K. Shoemake, "Plücker coordinate
// tutorial", Ray Tracing News 11(1), 1998.
#include "radiosity/rays/NearestHit.h"

#include "radiosity/rays/Margins.h"

#include <cmath>
#include <numbers>
#include <tuple>

namespace penumbra {

namespace {

/// On which side of a ray the edges of a triangle pass.
struct EdgeSides {
    EdgeSides(glm::dvec3 origin, glm::dvec3 direction, std::span<const glm::vec3, 3> corners)
        : a(glm::dvec3(corners[0]) - origin), b(glm::dvec3(corners[1]) - origin),
          c(glm::dvec3(corners[2]) - origin),
          // Those of an edge that is taken the other way round differ in their sign alone.
          sideA(glm::dot(glm::cross(b, c), direction)),
          sideB(glm::dot(glm::cross(c, a), direction)),
          sideC(glm::dot(glm::cross(a, b), direction)) {}

    /// Neither if the ray passes beside the triangle, both if it runs along it.
    bool back() const { return sideA >= 0 && sideB >= 0 && sideC >= 0; }
    bool front() const { return sideA <= 0 && sideB <= 0 && sideC <= 0; }
    bool passes() const { return back() != front(); }

    glm::dvec3 a, b, c; ///< corners from the ray's origin
    double sideA, sideB, sideC;
};

} // namespace

bool passes(glm::dvec3 origin, glm::dvec3 direction, std::span<const glm::vec3, 3> corners) {
    return EdgeSides(origin, direction, corners).passes();
}

bool NearestHit::take(std::span<const glm::vec3, 3> corners, const RayHit& hit,
                      std::uint8_t sides) {
    const EdgeSides edges(origin_, direction_, corners);
    const auto& [a, b, c, sideA, sideB, sideC] = edges;
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const bool back = glm::dot(direction_, normal) >= 0;
    if (!(sides & (back ? kBack : kFront))) return false;
    if (!edges.passes()) {
        if (hit.distance < doubt_.distance) {
            doubt_ = hit;
            doubt_.back = back;
            middle_ = (a + b + c) / 3.0;
        }
        return false;
    }
    const double distance = glm::dot(a, normal) / glm::dot(direction_, normal);
    if (!(distance >= 0) || distance > distance_) return false;
    if (distance == distance_ && std::tuple(hit_.key, hit_.object.value, hit_.triangle) <=
                                     std::tuple(hit.key, hit.object.value, hit.triangle))
        return false;
    const double sum = sideA + sideB + sideC;
    distance_ = distance;
    hit_ = hit;
    hit_.distance = float(distance);
    hit_.back = back;
    hit_.u = float(sideB / sum);
    hit_.v = float(sideC / sum);
    return true;
}

/// \param distance [in units of the direction] \return [m]
float NearestHit::hairAt(double distance) const {
    const glm::vec3 there(origin_ + distance * direction_);
    return roundingAt(std::max(magnitude(glm::vec3(origin_)), magnitude(there)));
}

float NearestHit::searchEnd() const {
    return float(distance_ + double(hairAt(distance_)) / glm::length(direction_));
}

bool NearestHit::inDoubt() const {
    constexpr double kClose = 20; // hairs
    if (!(doubt_.distance < distance_)) return false;
    const double slack = kClose * double(hair()) / glm::length(direction_);
    return double(doubt_.distance) + slack < distance_;
}

glm::vec3 NearestHit::beside(float hair, int i) const {
    const glm::dvec3 ray = glm::normalize(direction_);
    const glm::dvec3 axis = std::abs(ray.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 u = glm::normalize(glm::cross(axis, ray)), v = glm::cross(ray, u);
    const double turn = 2 * std::numbers::pi * (i + 0.3) / kAround; // seldom along an edge
    return double(hair) * (std::cos(turn) * u + std::sin(turn) * v);
}

glm::vec3 NearestHit::aside(float hair) const {
    const glm::dvec3 at = double(doubt_.distance) * direction_;
    const glm::dvec3 ray = direction_ / glm::length(direction_);
    const glm::dvec3 away = (at - middle_) - glm::dot(at - middle_, ray) * ray;
    const double far = glm::length(away);
    return far > 0 ? glm::vec3(double(hair) / far * away) : glm::vec3(0);
}

} // namespace penumbra
