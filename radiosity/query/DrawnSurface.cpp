#include "radiosity/query/DrawnSurface.h"

#include <cassert>

namespace penumbra {

namespace {

/// \param triangles is given what each triangle is
RayMesh meshOf(const PatchSet& patches, std::uint32_t object,
               std::vector<std::uint32_t>& triangles) {
    RayMesh mesh;
    const ObjectPart& part = patches.objects[object];
    mesh.key = part.key;
    if (!part.present) return mesh;
    mesh.vertices.reserve(part.vertices.count);
    for (std::uint32_t v = part.vertices.first; v < part.vertices.end(); ++v)
        mesh.vertices.push_back(patches.vertices[v].position);
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
    : patches_(patches), triangles_(patches.objects.size()), rays_(meshes(), patches.skin) {}

std::vector<RayMesh> DrawnSurface::meshes() {
    std::vector<RayMesh> meshes;
    for (std::uint32_t o = 0; o < triangles_.size(); ++o)
        meshes.push_back(meshOf(patches_, o, triangles_[o]));
    return meshes;
}

DrawnHit DrawnSurface::nearest(glm::vec3 origin, glm::vec3 direction, float reach) const {
    const RayHit ray = rays_.nearest(origin, direction, reach, RayScene::Faces::front);
    DrawnHit hit;
    if (!ray.met()) return hit;
    const std::uint32_t triangle = triangles_[ray.object.value][ray.triangle];
    hit.element = triangle / 2;
    hit.distance = ray.distance;
    const auto& v = patches_.elements[hit.element].vertices;
    const bool second = hit.second = triangle % 2 == 1;
    hit.vertices = {v[0], v[second ? 2 : 1], v[second ? 3 : 2]};
    hit.weights = {1 - ray.u - ray.v, ray.u, ray.v};
    return hit;
}

} // namespace penumbra
