#include "viewer/Arrangements.h"

#include "radiosity/LightShapes.h"
#include "radiosity/RadiosityNode.h"
#include "scenegraph/Light.h"
#include "scenegraph/Mesh.h"

#include <algorithm>
#include <numbers>

namespace penumbra {

namespace {

template <class T>
const Placed<T>* find(const std::vector<Placed<T>>& list, const std::string& path) {
    const auto found =
        std::find_if(list.begin(), list.end(), [&](const auto& p) { return p.path == path; });
    return found != list.end() ? &*found : nullptr;
}

} // namespace

std::vector<Emitter> emittersOf(const RadiosityNode& node, const std::string& lamp) {
    if (const Placed<Light>* const light = find(node.placed().lights, lamp)) {
        if (!node.placed().objects[light->object.value].visible) return {};
        return {lightEmitter(*light->node, light->toWorld)};
    }
    for (const LitObject& object : node.objects())
        for (const ShiningMesh& mesh : object.shining) {
            if (mesh.path != lamp || !object.visible) continue;
            const Pose pose = placementOf(object.toNode * object.toObject).pose;
            std::vector<Emitter> emitters;
            for (const Emitter& own : mesh.emitters) emitters.push_back(placedEmitter(own, pose));
            return emitters;
        }
    return {};
}

Rgb exitanceOf(const PlacedScene& placed, const std::string& lamp) {
    constexpr float kPi = std::numbers::pi_v<float>;
    if (const Placed<Light>* const light = find(placed.lights, lamp))
        return kPi * light->node->luminance();
    const Placed<Mesh>* const mesh = find(placed.meshes, lamp);
    for (std::size_t face = 0; mesh && face < mesh->node->faceCount(); ++face)
        if (const Material& material = *mesh->node->materialOf(face); material.emissive())
            return kPi * material.emission(); // all that shines of it is alike, see ShiningMesh
    return {};
}

Arrangement arrangementOf(const RadiosityNode& node, std::span<const std::string> lamps) {
    Arrangement arrangement;
    for (const LitObject& object : node.objects())
        arrangement.objects.push_back(
            {object.toNode * object.toObject, object.visible && object.geometry});
    for (const std::string& path : lamps) arrangement.lamps.push_back(emittersOf(node, path));
    return arrangement;
}

bool hasShadowMaps(std::span<const Emitter> lamp) {
    return lamp.size() == 1 && (lamp[0].kind != Emitter::Kind::polygons ||
                                (lamp[0].polygons.size() == 1 && lamp[0].polygons[0].size() == 4));
}

bool sameLamp(std::span<const Emitter> a, std::span<const Emitter> b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const Emitter& x, const Emitter& y) {
                          return x.polygons == y.polygons && x.centre == y.centre &&
                                 x.axis == y.axis && x.radius == y.radius;
                      });
}

bool sameArrangement(const Arrangement& a, const Arrangement& b) {
    return a.objects == b.objects &&
           std::equal(a.lamps.begin(), a.lamps.end(), b.lamps.begin(), b.lamps.end(),
                      [](const auto& x, const auto& y) { return sameLamp(x, y); });
}

} // namespace penumbra
