#include "viewer/Arrangements.h"

#include "radiosity/LightShapes.h"
#include "radiosity/RadiosityNode.h"
#include "scenegraph/Light.h"

#include <algorithm>

namespace penumbra {

Arrangement arrangementOf(const RadiosityNode& node, std::span<const std::string> lamps) {
    Arrangement arrangement;
    for (const LitObject& object : node.objects())
        arrangement.objects.push_back(
            {object.toNode * object.toObject, object.visible && object.geometry});
    const PlacedScene& placed = node.placed();
    for (const std::string& path : lamps) {
        const auto light = std::find_if(placed.lights.begin(), placed.lights.end(),
                                        [&](const auto& l) { return l.path == path; });
        const bool shown =
            light != placed.lights.end() && placed.objects[light->object.value].visible;
        std::optional<Emitter> lamp;
        if (shown) lamp = lightEmitter(*light->node, light->toWorld);
        arrangement.lamps.push_back(std::move(lamp));
    }
    return arrangement;
}

bool canBeDrawnLive(const Emitter& lamp) {
    return lamp.kind != Emitter::Kind::polygons ||
           (lamp.polygons.size() == 1 && lamp.polygons.front().size() == 4);
}

bool sameLamp(const std::optional<Emitter>& a, const std::optional<Emitter>& b) {
    if (!a || !b) return !a && !b;
    return a->polygons == b->polygons && a->centre == b->centre && a->axis == b->axis &&
           a->radius == b->radius;
}

bool sameArrangement(const Arrangement& a, const Arrangement& b) {
    return a.objects == b.objects &&
           std::equal(a.lamps.begin(), a.lamps.end(), b.lamps.begin(), b.lamps.end(), sameLamp);
}

} // namespace penumbra
