#include "viewer/preview/SceneStates.h"

#include "radiosity/mesh/Emitters.h"
#include "radiosity/process/RadiosityNode.h"
#include "scenegraph/Light.h"
#include "scenegraph/Mesh.h"

#include <algorithm>

namespace penumbra {

namespace {

template <class T>
const Placed<T>* find(const std::vector<Placed<T>>& list, const std::string& path) {
    const auto found =
        std::find_if(list.begin(), list.end(), [&](const auto& p) { return p.path == path; });
    return found != list.end() ? &*found : nullptr;
}

} // namespace

std::vector<Emitter> emittersOf(const RadiosityNode& node, const std::string& source) {
    if (const Placed<Light>* const light = find(node.placed().lights, source)) {
        if (!node.placed().objects[light->object.value].visible) return {};
        return {lightEmitter(*light->node, light->toWorld)};
    }
    for (const LitObject& object : node.objects())
        for (const EmissiveMesh& mesh : object.emissive) {
            if (mesh.path != source || !object.visible) continue;
            const Pose pose = placementOf(object.toNode * object.toObject).pose;
            std::vector<Emitter> emitters;
            for (const Emitter& own : mesh.emitters) emitters.push_back(placedEmitter(own, pose));
            return emitters;
        }
    return {};
}

Rgb exitanceOf(const PlacedScene& placed, const std::string& source) {
    if (const Placed<Light>* const light = find(placed.lights, source))
        return lambertianExitance(light->node->luminance());
    const Placed<Mesh>* const mesh = find(placed.meshes, source);
    for (std::size_t face = 0; mesh && face < mesh->node->faceCount(); ++face)
        if (const Material& material = *mesh->node->materialOf(face); material.emissive())
            return lambertianExitance(
                material.emission()); // all of its emitting faces are alike, see EmissiveMesh
    return {};
}

SceneState sceneStateOf(const RadiosityNode& node, std::span<const std::string> lights) {
    SceneState sceneState;
    for (const LitObject& object : node.objects())
        sceneState.objects.push_back(
            {object.toNode * object.toObject, object.visible && object.geometry});
    for (const std::string& path : lights) sceneState.lights.push_back(emittersOf(node, path));
    return sceneState;
}

bool hasShadowMaps(std::span<const Emitter> source) {
    return source.size() == 1 &&
           (source[0].kind != Emitter::Kind::polygons ||
            (source[0].polygons.size() == 1 && source[0].polygons[0].size() == 4));
}

bool sameLight(std::span<const Emitter> a, std::span<const Emitter> b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const Emitter& x, const Emitter& y) {
                          return x.polygons == y.polygons && x.centre == y.centre &&
                                 x.axis == y.axis && x.radius == y.radius;
                      });
}

bool sameSceneState(const SceneState& a, const SceneState& b) {
    return a.objects == b.objects &&
           std::equal(a.lights.begin(), a.lights.end(), b.lights.begin(), b.lights.end(),
                      [](const auto& x, const auto& y) { return sameLight(x, y); });
}

} // namespace penumbra
