// Axes around a direction.
#pragma once

#include <glm/glm.hpp>

#include <cmath>

namespace penumbra {

/// Orthonormal, u x v = normal; a function of the direction alone. \pre a unit vector
struct Frame {
    glm::vec3 u, v, normal;

    explicit Frame(glm::vec3 n) : normal(n) {
        const glm::vec3 helper = std::abs(n.x) < 0.7f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
        u = glm::normalize(glm::cross(n, helper));
        v = glm::cross(n, u);
    }
};

} // namespace penumbra
