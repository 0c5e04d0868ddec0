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

/// Adds the triangles of one surface.
class RayAdder {
public:
    RayAdder(const SurfaceMesh& mesh, const Tessellation& tessellation, RayMesh& rays)
        : mesh_(mesh), tessellation_(tessellation), rays_(rays), flat_(tessellation.cells.size()) {}

    void addFlatCells() {
        const std::vector<Cell>& cells = tessellation_.cells;
        RaySource whole; // all cells of the face at hand: facets reach over from one into the other
        for (std::uint32_t c = 0; c < cells.size(); ++c) {
            if (c == whole.firstCell + whole.cellCount) whole = {c, 1};
            while (whole.firstCell + whole.cellCount < cells.size() &&
                   cells[whole.firstCell + whole.cellCount].face == cells[c].face)
                ++whole.cellCount;
            const Cell& cell = cells[c];
            const auto corners = mesh_.cornersOf(mesh_.faces[cell.face]);
            const glm::dvec3 normal = newellNormal(mesh_.points, corners);
            flat_[c] = !tessellation_.smooth && glm::length(normal) > 0 &&
                       planar(tessellation_, cell, glm::vec3(glm::normalize(normal)));
            if (!flat_[c]) continue;
            const auto base = std::uint32_t(rays_.vertices.size());
            for (std::uint32_t i = 0; i < cell.cornerCount; ++i)
                rays_.vertices.push_back(tessellation_.outline[cell.firstCorner + i]);
            for (std::uint32_t i = 2; i < cell.cornerCount; ++i)
                add(whole, {base, base + i - 1, base + i});
        }
    }

    /// Of the cells that are not flat.
    void addFacets() {
        std::vector<std::uint32_t> facets(tessellation_.cells.size()); // so far
        for (const Facet& facet : tessellation_.facets) {
            const RaySource source{facet.cell, 1, facets[facet.cell]++};
            if (flat_[facet.cell]) continue;
            const auto& v = facet.vertices;
            add(source, {vertex(v[0]), vertex(v[1]), vertex(v[2])});
            if (v[2] != v[3]) add(source, {vertex(v[0]), vertex(v[2]), vertex(v[3])});
        }
    }

    std::vector<RaySource> sources;

private:
    void add(RaySource source, std::array<std::uint32_t, 3> t) {
        const SurfaceFace& face = mesh_.faces[tessellation_.cells[source.firstCell].face];
        source.turned = face.solid && !face.front; // inside out: its outside is its back
        if (source.turned) std::swap(t[1], t[2]);
        rays_.triangles.push_back(t);
        rays_.solid.push_back(face.solid);
        sources.push_back(source);
    }
    std::uint32_t vertex(std::uint32_t v) {
        const auto [found, fresh] = index_.try_emplace(v, std::uint32_t(rays_.vertices.size()));
        if (fresh) rays_.vertices.push_back(tessellation_.vertices[v].position);
        return found->second;
    }

    const SurfaceMesh& mesh_;
    const Tessellation& tessellation_;
    RayMesh& rays_;
    std::vector<std::uint8_t> flat_; ///< cells
    std::unordered_map<std::uint32_t, std::uint32_t> index_;
};

} // namespace

std::vector<RaySource> addRays(const SurfaceMesh& mesh, const Tessellation& tessellation,
                               RayMesh& rays) {
    RayAdder adder(mesh, tessellation, rays);
    adder.addFlatCells();
    adder.addFacets();
    return std::move(adder.sources);
}

} // namespace penumbra
