#include "radiosity/query/LightProbe.h"

#include "radiosity/mesh/Emitters.h"
#include "radiosity/rows/EmitterSender.h"
#include "scenegraph/Light.h"
#include "scenegraph/Mesh.h"

#include <algorithm>
#include <map>
#include <tuple>

namespace penumbra {

namespace {

constexpr int kSamples = 64;
constexpr double kSkin = 1e-4; // how far the point is lifted off its surface [m]

/// The emitting faces of a mesh, as one emitter for each colour.
std::vector<Emitter> meshEmitters(const Placed<Mesh>& placed) {
    const MeshData& data = placed.node->data();
    std::map<const Material*, Emitter> byMaterial;
    std::size_t first = 0;
    for (std::size_t face = 0; face < placed.node->faceCount(); ++face) {
        const auto count = std::size_t(data.faceVertexCounts[face]);
        const Material& material = *placed.node->materialOf(face);
        if (material.emissive()) {
            Emitter& emitter = byMaterial[&material];
            std::vector<glm::vec3>& polygon = emitter.polygons.emplace_back();
            for (std::size_t i = first; i < first + count; ++i) {
                const glm::vec3 point = data.points[std::size_t(data.faceVertexIndices[i])];
                polygon.push_back(glm::vec3(placed.toWorld * glm::dvec4(point, 1)));
            }
            emitter.area += polygonArea(polygon);
            emitter.exitance = lambertianExitance(material.meanEmission());
            emitter.path = placed.path;
        }
        first += count;
    }
    std::vector<Emitter> emitters;
    for (auto& [material, emitter] : byMaterial)
        if (emitter.area > 0) emitters.push_back(std::move(emitter));
    return emitters;
}

std::vector<Emitter> emittersOf(const PlacedScene& scene) {
    std::vector<Emitter> emitters;
    const auto shown = [&](ObjectId object) { return scene.objects[object.value].visible; };
    for (const auto& light : scene.lights) {
        if (!shown(light.object)) continue;
        emitters.push_back(lightEmitter(*light.node, light.toWorld));
        emitters.back().path = light.path;
    }
    for (const auto& mesh : scene.meshes)
        if (shown(mesh.object))
            for (Emitter& emitter : meshEmitters(mesh)) emitters.push_back(std::move(emitter));
    return emitters;
}

/// Charges the blockers of one emitter.
void account(EmitterAccount& source, const Emitter& emitter, const RayScene& rays,
             const Receiver& receiver) {
    const EmitterSender sender(emitter, kSamples, kSamples);
    const float factor = sender.formFactor(receiver);
    if (!(factor > 0)) return;
    double total = 0, seen = 0;
    std::map<std::uint32_t, double> blocked;
    SampleGroup group;
    for (int first = 0; first < kSamples; first += 16) {
        sender.sampleGroup(receiver, first, group);
        rays.occluded(group.rays);
        for (int i = 0; i < 16; ++i) {
            if (!(group.rays.used >> i & 1)) continue;
            const double weight = double(group.weight[i]);
            total += weight;
            const std::uint32_t blocker = group.rays.blocker[i];
            (blocker == ObjectId::kNone ? seen : blocked[blocker]) += weight;
        }
    }
    if (!(total > 0)) return;
    source.unoccluded += emitter.exitance * factor;
    source.arrives += emitter.exitance * (factor * float(seen / total));
    for (const auto& [object, weight] : blocked)
        source.losses.push_back(
            {ObjectId{object}, emitter.exitance * (factor * float(weight / total))});
}

} // namespace

std::vector<EmitterAccount> probeLight(const PlacedScene& scene, const SceneRays& rays,
                                       glm::dvec3 position, glm::dvec3 normal) {
    const Receiver receiver{glm::vec3(position + kSkin * normal), glm::vec3(normal)};
    std::vector<EmitterAccount> lights;
    for (const Emitter& emitter : emittersOf(scene)) {
        EmitterAccount& source = lights.emplace_back();
        source.path = emitter.path;
        account(source, emitter, rays.rays(), receiver);
        std::stable_sort(source.losses.begin(), source.losses.end(),
                         [](const LightLoss& a, const LightLoss& b) {
                             return luminance(a.lux) > luminance(b.lux);
                         });
    }
    std::stable_sort(lights.begin(), lights.end(),
                     [](const EmitterAccount& a, const EmitterAccount& b) {
                         return std::tuple(luminance(a.lost()), luminance(a.arrives)) >
                                std::tuple(luminance(b.lost()), luminance(b.arrives));
                     });
    return lights;
}

} // namespace penumbra
