#include "radiosity/DrawnSurface.h"

namespace penumbra {

namespace {

RayMesh drawnTriangles(const PatchSet& patches, DrawnSurface::Which which,
                       std::vector<std::uint32_t>& triangles) {
    RayMesh mesh;
    mesh.vertices.reserve(patches.vertices.size());
    for (const Vertex& vertex : patches.vertices) mesh.vertices.push_back(vertex.position);
    for (std::uint32_t e = 0; e < patches.elements.size(); ++e) {
        const ObjectPart& part = patches.objects[patches.elementObject[e].value];
        if (!part.present || (part.movable && which == DrawnSurface::Which::fixed)) continue;
        const auto& v = patches.elements[e].vertices;
        mesh.triangles.push_back({v[0], v[1], v[2]});
        triangles.push_back(2 * e);
        if (patches.elements[e].isTriangle()) continue;
        mesh.triangles.push_back({v[0], v[2], v[3]});
        triangles.push_back(2 * e + 1);
    }
    return mesh;
}

} // namespace

DrawnSurface::DrawnSurface(const PatchSet& patches, Which which)
    : patches_(patches),
      rays_(std::array{drawnTriangles(patches, which, triangles_)}, patches.extent) {}

DrawnHit DrawnSurface::nearest(glm::vec3 origin, glm::vec3 direction, float reach) const {
    const RayHit ray = rays_.nearest(origin, direction, reach, RayScene::Faces::front);
    DrawnHit hit;
    if (!ray.met()) return hit;
    hit.element = triangles_[ray.triangle] / 2;
    hit.distance = ray.distance;
    const auto& v = patches_.elements[hit.element].vertices;
    const bool second = triangles_[ray.triangle] % 2 == 1;
    hit.vertices = {v[0], v[second ? 2 : 1], v[second ? 3 : 2]};
    hit.weights = {1 - ray.u - ray.v, ray.u, ray.v};
    return hit;
}

} // namespace penumbra
