// The guard before the ray tracer: what may be handed to it.
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <cmath>

namespace penumbra {

/// Nothing shorter is traced [m]: the square of a length must not vanish in single precision.
constexpr float kLeastLength = 1e-18f;

/// Whether a triangle may be part of what is traced: Embree ends the program where all that is left
/// to be divided lies in one point. \param corners each passes canBeTraced() [m, world]
inline bool isTraceable(const std::array<glm::vec3, 3>& corners) {
    const auto& [a, b, c] = corners;
    const glm::vec3 size = glm::max(glm::max(a, b), c) - glm::min(glm::min(a, b), c);
    return size.x > kLeastLength || size.y > kLeastLength || size.z > kLeastLength;
}

/// Whether a ray may be traced: Embree ends the program at what is no number or beyond 1.8e18. One
/// without direction meets nothing in any case. \param origin, direction [m]
inline bool isTraceable(glm::vec3 origin, glm::vec3 direction) {
    constexpr float kMost = 1e18f;
    const auto within = [](glm::vec3 v) { // without branches; not a number: false
        return (std::abs(v.x) < kMost) & (std::abs(v.y) < kMost) & (std::abs(v.z) < kMost);
    };
    return within(origin) & within(direction);
}

} // namespace penumbra
