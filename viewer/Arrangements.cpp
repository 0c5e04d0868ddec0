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

bool sameArrangement(const Arrangement& a, const Arrangement& b) {
    const auto samePlace = [](const std::optional<Emitter>& l, const std::optional<Emitter>& m) {
        if (!l || !m) return !l && !m;
        return l->polygons == m->polygons && l->centre == m->centre && l->axis == m->axis &&
               l->radius == m->radius;
    };
    return a.objects == b.objects && std::equal(a.lamps.begin(), a.lamps.end(), b.lamps.begin(),
                                                b.lamps.end(), samePlace);
}

} // namespace penumbra
