#include "viewer/preview/PreviewLightChoice.h"

#include "radiosity/mesh/Emitters.h"
#include "radiosity/process/RadiosityNode.h"
#include "scenegraph/Light.h"
#include "scenegraph/Mesh.h"
#include "viewer/preview/SceneStates.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace penumbra {

namespace {

/// Share of an object's corners and middle that sees a point.
double seenShare(const SceneRays& rays, const Bounds& box, ObjectId object, glm::dvec3 source,
                 ObjectId lightObject) {
    int seen = 0;
    for (int i = 0; i < 9; ++i) {
        const glm::vec3 way(i & 1 ? 0.45f : -0.45f, i & 2 ? 0.45f : -0.45f, i & 4 ? 0.45f : -0.45f);
        const glm::dvec3 from = box.centre() + (i < 8 ? way * box.size() : glm::vec3(0));
        const double reach = glm::distance(from, source);
        if (reach == 0) continue;
        const auto touch = rays.touch(from, (source - from) / reach, reach, object);
        seen += !touch || touch->object == lightObject;
    }
    return seen / 9.0;
}

glm::dvec3 middle(const std::vector<glm::vec3>& polygon) {
    glm::dvec3 sum(0);
    for (const glm::vec3 corner : polygon) sum += corner;
    return sum / double(polygon.size());
}

/// Illuminance of a small thing that faces an emitter, without obstacles, in far approximation
/// [lux].
double lightAt(const Emitter& emitter, glm::dvec3 thing) {
    const auto light = [&](glm::dvec3 centre, glm::dvec3 normal, double area) {
        const glm::dvec3 way = thing - centre;
        const double d2 = std::max(glm::dot(way, way), 1e-4);
        const double cosine = emitter.kind == Emitter::Kind::sphere
                                  ? 0.25 // a sphere shows a quarter of its area
                                  : std::max(0.0, glm::dot(normal, way) / std::sqrt(d2));
        return luminance(emitter.exitance) * area * cosine / (3.14159265358979 * d2 + area);
    };
    if (emitter.kind != Emitter::Kind::polygons)
        return light(emitter.centre, emitter.axis, emitter.area);
    double sum = 0;
    for (const auto& polygon : emitter.polygons) {
        const glm::dvec3 across = areaVector(polygon);
        const double area = glm::length(across);
        if (area > 0) sum += light(middle(polygon), across / area, area);
    }
    return sum;
}

/// Points of an emitter that are tested for whether they are seen.
glm::dvec3 centreOf(const Emitter& emitter) {
    if (emitter.kind != Emitter::Kind::polygons) return emitter.centre;
    glm::dvec3 sum(0);
    double area = 0;
    for (const auto& polygon : emitter.polygons) {
        const double part = polygonArea(polygon);
        sum += part * middle(polygon);
        area += part;
    }
    return sum / std::max(area, 1e-30);
}

} // namespace

std::vector<PreviewLight> previewableLights(const RadiosityNode& node, PreviewMethod by) {
    std::vector<PreviewLight> lights;
    const PlacedScene& placed = node.placed();
    const auto add = [&](const std::string& path, ObjectId object) {
        const Rgb exitance = exitanceOf(placed, path);
        if (maxChannel(exitance) <= 0) return;
        std::vector<Emitter> emitters = emittersOf(node, path);
        if (emitters.empty() || (by == PreviewMethod::maps && !hasShadowMaps(emitters))) return;
        for (Emitter& emitter : emitters) emitter.exitance = exitance;
        lights.push_back({path, object, std::move(emitters)});
    };
    for (const auto& light : placed.lights) add(light.path, light.object);
    for (const LitObject& object : node.objects())
        for (const EmissiveMesh& emissive : object.emissive) {
            const auto mesh = std::find_if(placed.meshes.begin(), placed.meshes.end(),
                                           [&](const auto& m) { return m.path == emissive.path; });
            if (mesh != placed.meshes.end()) add(mesh->path, mesh->object);
        }
    return lights;
}

PreviewLimits previewLimits(PreviewMethod by) {
    if (by == PreviewMethod::maps)
        return {.most = kMostPreviewedByMaps, .least = 0.05, .hidden = false};
    return {.most = kMostPreviewed, .least = 0.0005}; // a thousandth can be seen in the dark
}

std::vector<std::string> lightsThatMatter(const std::vector<PreviewLight>& lights,
                                          const SceneRays& rays, ObjectId object,
                                          const PreviewLimits& limits) {
    constexpr double kHidden = 0.5 / 9; // as if half a corner saw it
    struct Found {
        const PreviewLight* source;
        double light; ///< [lux]
        bool seen;
    };
    std::vector<Found> found;
    double sum = 0;
    const Bounds box = rays.bounds(object);
    for (const PreviewLight& source : lights) {
        if (source.object == object) {
            found.push_back({&source, std::numeric_limits<double>::infinity(), true});
            continue;
        }
        if (box.empty()) continue;
        double light = 0, free = 0;
        for (const Emitter& emitter : source.emitters)
            if (const double all = lightAt(emitter, box.centre()); all > 0) {
                free += all;
                light += all * seenShare(rays, box, object, centreOf(emitter), source.object);
            }
        sum += light;
        if (light > 0)
            found.push_back({&source, light, true});
        else if (limits.hidden && free > 0)
            found.push_back({&source, kHidden * free, false});
    }
    std::erase_if(found, [&](const Found& one) { return one.light < limits.least * sum; });
    std::ranges::stable_sort(found, [](const Found& a, const Found& b) {
        return a.seen != b.seen ? a.seen : a.light > b.light;
    });
    std::vector<std::string> paths;
    std::size_t emitters = 0;
    for (const Found& one : found) {
        if (emitters + one.source->emitters.size() > limits.most) continue;
        emitters += one.source->emitters.size();
        paths.push_back(one.source->path);
    }
    return paths;
}

} // namespace penumbra
