// Axis-aligned boxes.
#pragma once

#include <glm/glm.hpp>

#include <limits>

namespace penumbra {

/// An axis-aligned box [m]. A fresh one is empty: lower > upper.
struct Bounds {
    glm::vec3 lower{std::numeric_limits<float>::infinity()};
    glm::vec3 upper{-std::numeric_limits<float>::infinity()};

    bool empty() const { return lower.x > upper.x || lower.y > upper.y || lower.z > upper.z; }
    glm::vec3 centre() const { return 0.5f * (lower + upper); }
    glm::vec3 size() const { return empty() ? glm::vec3(0) : upper - lower; }
    float diagonal() const { return glm::length(size()); }

    void add(glm::vec3 p) {
        lower = glm::min(lower, p);
        upper = glm::max(upper, p);
    }
    void add(const Bounds& b) {
        lower = glm::min(lower, b.lower);
        upper = glm::max(upper, b.upper);
    }
    bool overlaps(const Bounds& b) const {
        return glm::all(glm::lessThanEqual(lower, b.upper)) &&
               glm::all(glm::lessThanEqual(b.lower, upper));
    }
    friend bool operator==(const Bounds&, const Bounds&) = default;
    bool contains(glm::vec3 p) const {
        return glm::all(glm::lessThanEqual(lower, p)) && glm::all(glm::lessThanEqual(p, upper));
    }
};

/// Smallest box around `box` after the affine `matrix`: exact for the eight corners (Arvo 1990).
Bounds transformed(const Bounds& box, const glm::dmat4& matrix);

} // namespace penumbra
