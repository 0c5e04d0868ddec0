#include "radiosity/query/FallbackLight.h"

#include <cmath>

namespace penumbra {

Lighting fallbackLight(const PatchSet& patches, const View& view) {
    const glm::dvec3 eye(glm::inverse(view.worldToCamera)[3]);
    Lighting light;
    light.direct.resize(patches.vertices.size());
    light.indirect.resize(patches.vertices.size());
    for (std::size_t v = 0; v < patches.vertices.size(); ++v) {
        const Receiver& receiver = patches.vertices[v].receiver;
        const glm::vec3 toEye(eye - glm::dvec3(receiver.position));
        const float distance = glm::length(toEye);
        if (!(distance > 0)) continue;
        const float headOn = std::abs(glm::dot(receiver.normal, toEye / distance));
        light.indirect[v] = Rgb(kFallbackIlluminance * (0.5f + 0.5f * headOn));
    }
    return light;
}

} // namespace penumbra
