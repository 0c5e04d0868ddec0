// Malley's method: points of the unit disk lifted onto the hemisphere are spread by the cosine.
#include "radiosity/rows/HemisphereRays.h"

#include "radiosity/rows/SenderSamples.h"

#include <cmath>

namespace penumbra {

HemisphereRays::HemisphereRays(int count) {
    for (int i = 0; i < count; ++i) {
        const glm::vec2 p = squareToDisk(sobol02(std::uint32_t(i), std::size_t(count)));
        local_.emplace_back(p, std::sqrt(std::max(0.0f, 1 - glm::dot(p, p))));
    }
}

glm::vec3 HemisphereRays::direction(int index, glm::vec3 normal) const {
    return direction(index, Frame(normal));
}

glm::vec3 HemisphereRays::direction(int index, const Frame& frame) const {
    const glm::vec3 d = local_[std::size_t(index)];
    return d.x * frame.u + d.y * frame.v + d.z * frame.normal;
}

std::uint64_t HemisphereRays::towards(glm::vec3 away, float radius, glm::vec3 normal) const {
    const Frame frame(normal);
    const glm::vec3 axis(glm::dot(away, frame.u), glm::dot(away, frame.v), glm::dot(away, normal));
    // A ray d passes the sphere if d . axis >= sqrt(distance^2 - radius^2); hairs are for rounding.
    const float distance2 = glm::dot(away, away);
    const float tangent2 = 0.99999f * distance2 - radius * radius;
    const float least = tangent2 > 0 ? std::sqrt(tangent2) - 1e-5f * std::sqrt(distance2) : -1e30f;
    std::uint64_t passing = 0;
    for (std::size_t i = 0; i < local_.size(); ++i)
        passing |= std::uint64_t(glm::dot(local_[i], axis) >= least) << i;
    return passing;
}

} // namespace penumbra
