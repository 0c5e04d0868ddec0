// Malley's method: points of the unit disk lifted onto the hemisphere are spread by the cosine.
#include "radiosity/HemisphereRays.h"

#include "radiosity/SenderSamples.h"

#include <cmath>

namespace penumbra {

HemisphereRays::HemisphereRays(int count) {
    for (int i = 0; i < count; ++i) {
        const glm::vec2 p = squareToDisk(sobol02(std::uint32_t(i), std::size_t(count)));
        local_.emplace_back(p, std::sqrt(std::max(0.0f, 1 - glm::dot(p, p))));
    }
}

glm::vec3 HemisphereRays::direction(int index, glm::vec3 normal) const {
    const glm::vec3 helper = std::abs(normal.x) < 0.7f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
    const glm::vec3 u = glm::normalize(glm::cross(normal, helper));
    const glm::vec3 v = glm::cross(normal, u);
    const glm::vec3 d = local_[std::size_t(index)];
    return d.x * u + d.y * v + d.z * normal;
}

} // namespace penumbra
