#include "radiosity/mesh/DrawnSurface.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace penumbra {

namespace {

/// All objects, by the keys of their paths.
std::vector<std::uint32_t> objectsByKey(const PatchSet& patches) {
    std::vector<std::uint32_t> order(patches.objects.size());
    for (std::uint32_t o = 0; o < order.size(); ++o) order[o] = o;
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return std::pair(patches.objects[a].key, a) < std::pair(patches.objects[b].key, b);
    });
    return order;
}

/// Where an object's vertices are drawn now [m, world].
std::vector<glm::vec3> clusterOf(const PatchSet& patches, std::uint32_t object) {
    const Range range = patches.objects[object].vertices;
    std::vector<glm::vec3> place;
    place.reserve(range.count);
    for (std::uint32_t v = range.first; v < range.end(); ++v)
        place.push_back(patches.vertices[v].position);
    return place;
}

/// \param triangles is given what each triangle is
RayMesh meshOf(const PatchSet& patches, std::uint32_t object,
               std::vector<std::uint32_t>& triangles) {
    RayMesh mesh;
    mesh.vertices = clusterOf(patches, object);
    const ObjectPart& part = patches.objects[object];
    for (std::uint32_t e = part.elements.first; e < part.elements.end(); ++e) {
        // Corners that Coverage hands out come and go; they are drawn where the shared ones are.
        const Element& element = patches.uncoveredElements[e];
        const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
            std::array<std::uint32_t, 3> corners{element.vertices[a], element.vertices[b],
                                                 element.vertices[c]};
            for (std::uint32_t& corner : corners) {
                assert(part.vertices.contains(corner));
                corner -= part.vertices.first;
            }
            mesh.triangles.push_back(corners);
        };
        add(0, 1, 2);
        triangles.push_back(2 * e);
        if (element.isTriangle()) continue;
        add(0, 2, 3);
        triangles.push_back(2 * e + 1);
    }
    return mesh;
}

} // namespace

glm::vec2 uvOf(const PatchSet& patches, const DrawnHit& hit) {
    if (patches.textures.uvs.empty()) return glm::vec2(0);
    const auto& uv = patches.textures.uvs[hit.element];
    return hit.weights[0] * uv[0] + hit.weights[1] * uv[hit.second ? 2 : 1] +
           hit.weights[2] * uv[hit.second ? 3 : 2];
}

DrawnSurface::DrawnSurface(const PatchSet& patches)
    : patches_(patches), rays_(meshes(), patches.skin) {
    hideAbsent();
}

/// All of it anew: which of two surfaces that lie on each other is met depends on the order of
/// objects, in which the new ones have their places.
void DrawnSurface::grow() {
    rays_ = RayScene(meshes(), patches_.skin);
    hideAbsent();
}

void DrawnSurface::hideAbsent() {
    for (std::uint32_t p = 0; p < parts_.size(); ++p)
        if (!patches_.objects[parts_[p].object].present) rays_.show({p}, false);
    rays_.commit();
}

std::vector<RayMesh> DrawnSurface::meshes() {
    parts_.clear();
    partOf_.resize(patches_.objects.size());
    std::vector<RayMesh> meshes;
    for (std::uint32_t object : objectsByKey(patches_)) {
        partOf_[object] = std::uint32_t(parts_.size());
        Part& part = parts_.emplace_back(Part{object, {}});
        meshes.push_back(meshOf(patches_, object, part.triangles));
    }
    return meshes;
}

void DrawnSurface::follow(std::span<const ObjectId> objects) {
    if (objects.empty()) return;
    for (ObjectId object : objects) {
        const std::uint32_t part = partOf_[object.value];
        const bool present = patches_.objects[object.value].present;
        if (present) rays_.move({part}, clusterOf(patches_, object.value));
        rays_.show({part}, present);
    }
    rays_.commit();
}

DrawnHit DrawnSurface::nearest(glm::vec3 origin, glm::vec3 direction, float reach) const {
    const RayHit ray = rays_.nearest(origin, direction, reach, RayScene::Faces::front);
    DrawnHit hit;
    if (!ray.met()) return hit;
    const std::uint32_t triangle = parts_[ray.object.value].triangles[ray.triangle];
    hit.element = triangle / 2;
    hit.distance = ray.distance;
    const auto& v = patches_.elements[hit.element].vertices;
    const bool second = hit.second = triangle % 2 == 1;
    hit.vertices = {v[0], v[second ? 2 : 1], v[second ? 3 : 2]};
    hit.weights = {1 - ray.u - ray.v, ray.u, ray.v};
    return hit;
}

} // namespace penumbra
