#include "radiosity/surface/SurfaceRays.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

namespace penumbra {

namespace {

bool planar(const Tessellation& tessellation, const Cell& cell, glm::vec3 normal) {
    const glm::vec3 origin = tessellation.outline[cell.firstCorner];
    float reach = 0, depth = 0;
    for (std::uint32_t i = 1; i < cell.cornerCount; ++i) {
        const glm::vec3 d = tessellation.outline[cell.firstCorner + i] - origin;
        reach = std::max(reach, glm::length(d));
        depth = std::max(depth, std::abs(glm::dot(d, normal)));
    }
    return depth <= 1e-4f * reach;
}

} // namespace

std::vector<RaySource> addRays(const SurfaceMesh& mesh, const Tessellation& tessellation,
                               RayMesh& rays) {
    std::vector<RaySource> sources;
    std::vector<std::uint8_t> flat(tessellation.cells.size());
    const auto add = [&](RaySource source, std::array<std::uint32_t, 3> t) {
        const SurfaceFace& face = mesh.faces[tessellation.cells[source.firstCell].face];
        source.turned = face.solid && !face.front; // inside out: its outside is its back
        if (source.turned) std::swap(t[1], t[2]);
        rays.triangles.push_back(t);
        rays.solid.push_back(face.solid);
        sources.push_back(source);
    };
    RaySource whole; // all cells of the face at hand: facets reach over from one into the other
    for (std::uint32_t c = 0; c < tessellation.cells.size(); ++c) {
        if (c == whole.firstCell + whole.cellCount) whole = {c, 1};
        while (whole.firstCell + whole.cellCount < tessellation.cells.size() &&
               tessellation.cells[whole.firstCell + whole.cellCount].face ==
                   tessellation.cells[c].face)
            ++whole.cellCount;
        const Cell& cell = tessellation.cells[c];
        const SurfaceFace& face = mesh.faces[cell.face];
        const glm::dvec3 normal = newellNormal(mesh.points, mesh.cornersOf(face));
        flat[c] = !tessellation.smooth && glm::length(normal) > 0 &&
                  planar(tessellation, cell, glm::vec3(glm::normalize(normal)));
        if (!flat[c]) continue;
        const auto base = std::uint32_t(rays.vertices.size());
        for (std::uint32_t i = 0; i < cell.cornerCount; ++i)
            rays.vertices.push_back(tessellation.outline[cell.firstCorner + i]);
        for (std::uint32_t i = 2; i < cell.cornerCount; ++i)
            add(whole, {base, base + i - 1, base + i});
    }
    std::unordered_map<std::uint32_t, std::uint32_t> index;
    const auto vertex = [&](std::uint32_t v) {
        const auto [found, fresh] = index.try_emplace(v, std::uint32_t(rays.vertices.size()));
        if (fresh) rays.vertices.push_back(tessellation.vertices[v].position);
        return found->second;
    };
    std::vector<std::uint32_t> facets(tessellation.cells.size()); // so far
    for (const Facet& facet : tessellation.facets) {
        const std::uint32_t number = facets[facet.cell]++;
        if (flat[facet.cell]) continue;
        const auto& v = facet.vertices;
        const RaySource source{facet.cell, 1, number};
        add(source, {vertex(v[0]), vertex(v[1]), vertex(v[2])});
        if (v[2] != v[3]) add(source, {vertex(v[0]), vertex(v[2]), vertex(v[3])});
    }
    return sources;
}

} // namespace penumbra
