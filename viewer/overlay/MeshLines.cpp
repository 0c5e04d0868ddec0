#include "viewer/overlay/MeshLines.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <span>
#include <utility>

namespace penumbra {

namespace {

struct Edge {
    std::uint32_t patch, a, b; ///< a lies before b, see before()
};

/// An order of positions.
bool before(const glm::vec3& a, const glm::vec3& b) {
    return std::array{a.x, a.y, a.z} < std::array{b.x, b.y, b.z};
}

/// The edges of all elements, those of neighbours twice.
std::vector<Edge> edgesOf(const LitMeshData& mesh) {
    const std::size_t triangles = mesh.indices.size() / 3;
    const auto corner = [&](std::size_t triangle, std::size_t k) {
        return mesh.indices[3 * triangle + k % 3];
    };
    // a quadrilateral (a, b, c, d) is cut into (a, b, c), (a, c, d)
    const auto cutHere = [&](std::size_t triangle) {
        return triangle + 1 < triangles && corner(triangle, 0) == corner(triangle + 1, 0) &&
               corner(triangle, 2) == corner(triangle + 1, 1);
    };
    std::vector<Edge> edges;
    edges.reserve(2 * triangles);
    const auto add = [&](std::size_t triangle, std::size_t k) {
        std::uint32_t a = corner(triangle, k), b = corner(triangle, k + 1);
        if (before(mesh.positions[b], mesh.positions[a])) std::swap(a, b);
        edges.push_back({mesh.trianglePatch.empty() ? 0 : mesh.trianglePatch[triangle], a, b});
    };
    for (std::size_t t = 0; t < triangles; ++t) {
        const bool first = cutHere(t), second = !first && t > 0 && cutHere(t - 1);
        if (!second) add(t, 0);
        add(t, 1);
        if (!first) add(t, 2);
    }
    return edges;
}

} // namespace

MeshLines meshLines(const LitMeshData& mesh) {
    std::vector<Edge> edges = edgesOf(mesh);
    const auto order = [&](const Edge& e, const Edge& f) {
        if (e.patch != f.patch) return e.patch < f.patch;
        const glm::vec3 &a = mesh.positions[e.a], &b = mesh.positions[f.a];
        return a != b ? before(a, b) : before(mesh.positions[e.b], mesh.positions[f.b]);
    };
    std::sort(edges.begin(), edges.end(), order);
    MeshLines lines;
    for (std::size_t i = 0, next; i < edges.size(); i = next) {
        for (next = i + 1; next < edges.size() && !order(edges[i], edges[next]);) ++next;
        const bool outline = next == i + 1 && !mesh.trianglePatch.empty();
        auto& kind = outline ? lines.patches : lines.elements;
        kind.insert(kind.end(), {edges[i].a, edges[i].b});
    }
    return lines;
}

} // namespace penumbra
