#include "viewer/gl/UnlitLighting.h"

#include "radiosity/mesh/Emitters.h"
#include "radiosity/query/FallbackLight.h"
#include "scenegraph/Light.h"
#include "scenegraph/Mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace penumbra {

namespace {

constexpr float kPi = std::numbers::pi_v<float>;

/// A light and its whole flux.
struct Candidate {
    UnlitLight source;
    Rgb flux; ///< [lm]
};

Candidate lightCandidate(const Placed<Light>& placed) {
    const Emitter emitter = lightEmitter(*placed.node, placed.toWorld);
    const bool sphere = std::holds_alternative<SphereShape>(placed.node->shape());
    Candidate candidate;
    UnlitLight& source = candidate.source;
    source.position = glm::dvec3(placed.toWorld[3]);
    if (!sphere) source.axis = glm::normalize(-glm::dvec3(placed.toWorld[2]));
    source.area = float(emitter.area) * (sphere ? 0.25f : 1.0f);
    source.intensity = placed.node->luminance() * source.area;
    candidate.flux = emitter.exitance * float(emitter.area);
    return candidate;
}

/// The emissive faces of a mesh together, at their middle; all round if they face all ways.
Candidate meshCandidate(const Placed<Mesh>& placed) {
    const MeshData& data = placed.node->data();
    Candidate candidate;
    glm::dvec3 normals(0), middle(0);
    double area = 0;
    std::size_t first = 0;
    for (std::size_t face = 0; face < placed.node->faceCount(); ++face) {
        const auto count = std::size_t(data.faceVertexCounts[face]);
        const Rgb emission = placed.node->materialOf(face)->meanEmission();
        if (maxChannel(emission) > 0) {
            glm::dvec3 normal(0), centre(0);
            const auto at = [&](std::size_t corner) {
                const auto index = std::size_t(data.faceVertexIndices[first + corner % count]);
                return glm::dvec3(placed.toWorld * glm::dvec4(data.points[index], 1));
            };
            for (std::size_t i = 0; i < count; ++i) {
                normal += 0.5 * glm::cross(at(i) - at(0), at(i + 1) - at(0));
                centre += at(i) / double(count);
            }
            const double faceArea = glm::length(normal);
            area += faceArea;
            normals += normal;
            middle += faceArea * centre;
            candidate.flux += emission * (kPi * float(faceArea));
        }
        first += count;
    }
    if (!(area > 0)) return candidate;
    const bool oneSided = glm::length(normals) > 0.5 * area;
    candidate.source.position = middle / area;
    if (oneSided) candidate.source.axis = glm::normalize(normals);
    candidate.source.area = float(area) * (oneSided ? 1.0f : 0.25f);
    candidate.source.intensity = candidate.flux * ((oneSided ? 1.0f : 0.25f) / kPi);
    return candidate;
}

/// The objects that are seen.
template <class T>
bool shown(const PlacedScene& scene, const Placed<T>& placed) {
    return scene.objects[placed.object.value].visible;
}

} // namespace

UnlitLighting unlitLighting(const PlacedScene& scene) {
    std::vector<Candidate> candidates;
    for (const auto& light : scene.lights)
        if (shown(scene, light)) candidates.push_back(lightCandidate(light));
    for (const auto& mesh : scene.meshes) {
        const auto& materials = mesh.node->data().materials;
        const bool emits = std::any_of(materials.begin(), materials.end(),
                                       [](const auto& material) { return material->emissive(); });
        if (emits && shown(scene, mesh)) candidates.push_back(meshCandidate(mesh));
    }
    std::erase_if(candidates, [](const Candidate& c) { return !(luminance(c.flux) > 0); });
    std::stable_sort(candidates.begin(), candidates.end(), [](const auto& a, const auto& b) {
        return luminance(a.flux) > luminance(b.flux);
    });
    UnlitLighting lighting;
    const glm::vec3 size = scene.bounds.size();
    const float surface = 2 * (size.x * size.y + size.y * size.z + size.z * size.x);
    for (const Candidate& candidate : candidates) {
        if (surface > 0) lighting.ambient += candidate.flux * (1 / surface);
        if (lighting.lights.size() < UnlitLighting::kMostLights)
            lighting.lights.push_back(candidate.source);
    }
    if (!(luminance(lighting.ambient) > 0)) lighting.ambient = Rgb(kFallbackIlluminance);
    return lighting;
}

} // namespace penumbra
