#include "viewer/LampChoice.h"

#include "radiosity/LightShapes.h"
#include "scenegraph/Light.h"
#include "viewer/Arrangements.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace penumbra {

namespace {

constexpr double kLeastShare = 0.05;

/// Share of an object's corners and middle that sees a point.
double seenShare(const SceneRays& rays, const Bounds& box, ObjectId object, glm::dvec3 lamp,
                 ObjectId lampObject) {
    int seen = 0;
    for (int i = 0; i < 9; ++i) {
        const glm::vec3 way(i & 1 ? 0.45f : -0.45f, i & 2 ? 0.45f : -0.45f, i & 4 ? 0.45f : -0.45f);
        const glm::dvec3 from = box.centre() + (i < 8 ? way * box.size() : glm::vec3(0));
        const double reach = glm::distance(from, lamp);
        if (reach == 0) continue;
        const auto touch = rays.touch(from, (lamp - from) / reach, reach, object);
        seen += !touch || touch->object == lampObject;
    }
    return seen / 9.0;
}

/// Illuminance of a small thing that faces the lamp, without obstacles, in far approximation [lux].
double lightAt(const Emitter& lamp, glm::vec3 centre, glm::vec3 normal, glm::vec3 thing) {
    const glm::dvec3 way = glm::dvec3(thing) - glm::dvec3(centre);
    const double d2 = std::max(glm::dot(way, way), 1e-4);
    const double cosine = lamp.kind == Emitter::Kind::sphere
                              ? 0.25 // a sphere shows a quarter of its area
                              : std::max(0.0, glm::dot(glm::dvec3(normal), way) / std::sqrt(d2));
    return luminance(lamp.exitance) * lamp.area * cosine / (3.14159265358979 * d2 + lamp.area);
}

} // namespace

std::vector<std::size_t> lampsThatMatter(const PlacedScene& placed, const SceneRays& rays,
                                         ObjectId object, std::size_t most) {
    std::vector<std::pair<double, std::size_t>> found;
    double sum = 0;
    const Bounds box = rays.bounds(object);
    for (std::size_t l = 0; l < placed.lights.size(); ++l) {
        const auto& light = placed.lights[l];
        if (!placed.objects[light.object.value].visible) continue;
        const Emitter lamp = lightEmitter(*light.node, light.toWorld);
        if (!canBeDrawnLive(lamp) || maxChannel(lamp.exitance) <= 0) continue;
        if (light.object == object) {
            found.emplace_back(std::numeric_limits<double>::infinity(), l);
            continue;
        }
        if (box.empty()) continue;
        glm::vec3 normal = lamp.axis;
        if (lamp.kind == Emitter::Kind::polygons) {
            const auto& p = lamp.polygons.front();
            normal = glm::normalize(glm::cross(p[1] - p[0], p[2] - p[0]));
        }
        const double all = lightAt(lamp, lamp.centre, normal, box.centre());
        const double share =
            all > 0 ? seenShare(rays, box, object, glm::dvec3(lamp.centre), light.object) : 0;
        sum += all * share;
        if (share > 0) found.emplace_back(all * share, l);
    }
    std::erase_if(found, [&](const auto& lamp) { return lamp.first < kLeastShare * sum; });
    std::stable_sort(found.begin(), found.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<std::size_t> lamps;
    for (std::size_t i = 0; i < std::min(most, found.size()); ++i) lamps.push_back(found[i].second);
    return lamps;
}

} // namespace penumbra
