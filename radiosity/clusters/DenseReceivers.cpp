#include "radiosity/clusters/DenseReceivers.h"

#include "base/Bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

namespace penumbra {

namespace {

/// Cosine between normals of what looks the same way.
constexpr float kAlike = 0.94f;

/// Which vertices lie inside of a smooth piece of clusters (1): their faces are all around them and
/// look about the way that they do.
std::vector<std::uint8_t> smoothVertices(const DenseMesh& mesh) {
    std::vector<std::uint8_t> smooth(mesh.vertices.size());
    // Going around a vertex inside, each neighbour ends one face and begins another.
    std::vector<std::int64_t> open(mesh.vertices.size());
    const auto cornersOf = [](const auto& face) { return face[2] == face[3] ? 3u : 4u; };
    for (const auto& face : mesh.faces)
        for (std::size_t k = 0, count = cornersOf(face); k < count; ++k) {
            smooth[face[k]] = 1;
            open[face[k]] += std::int64_t(face[(k + 1) % count]);
            open[face[k]] -= std::int64_t(face[(k + count - 1) % count]);
        }
    for (const auto& face : mesh.faces) {
        const auto at = [&](std::size_t k) { return mesh.vertices[face[k]].position; };
        // Newell's normal of three or four corners; twice the area long.
        const glm::vec3 normal = cornersOf(face) == 3 ? glm::cross(at(1) - at(0), at(2) - at(0))
                                                      : glm::cross(at(2) - at(0), at(3) - at(1));
        const float least = kAlike * glm::length(normal);
        for (const std::uint32_t v : face)
            if (open[v] != 0 || !(glm::dot(normal, mesh.vertices[v].normal) > least)) smooth[v] = 0;
    }
    return smooth;
}

/// What of an object rises beside a vertex and takes light from there but not from farther away.
class Surroundings {
public:
    /// \param reach how far around [m]
    Surroundings(std::span<const DenseVertex> vertices, float reach)
        : vertices_(vertices), reach_(reach) {
        for (std::uint32_t v = 0; v < vertices.size(); ++v)
            places_.emplace_back(keyOf(cellOf(vertices[v].position)), v);
        std::sort(places_.begin(), places_.end());
        for (std::uint32_t i = 0; i < places_.size(); ++i)
            if (i == 0 || places_[i].first != places_[i - 1].first) cells_.push_back({i, {}, {}});
        for (std::size_t c = 0; c < cells_.size(); ++c) describe(c);
    }

    /// Removes those that something rises beside from `flat` (1: of interest).
    void sift(std::vector<std::uint8_t>& flat) const {
        std::vector<std::uint32_t> near;
        for (std::size_t c = 0; c < cells_.size(); ++c) {
            near.clear();
            for (std::size_t i = cells_[c].first; i < endOf(c); ++i) {
                std::uint8_t& is = flat[places_[i].second];
                if (is == 0) continue;
                if (near.empty()) listNear(c, near);
                const DenseVertex& vertex = vertices_[places_[i].second];
                if (std::ranges::any_of(near, [&](auto n) { return rises(vertex, cells_[n]); }))
                    is = 0;
            }
        }
    }

private:
    /// Outermost vertices in these directions and the opposite ones stand for those of a cell.
    static constexpr std::array<glm::vec3, 7> kDirections{
        {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}, {1, 1, -1}, {1, -1, 1}, {-1, 1, 1}}};
    struct Cell {
        std::uint32_t first = 0; ///< of places_
        std::array<std::uint32_t, 2 * kDirections.size()> outermost{};
        Bounds box;
    };

    glm::ivec3 cellOf(glm::vec3 p) const { return glm::ivec3(glm::floor(p / reach_)); }
    static std::uint64_t keyOf(glm::ivec3 cell) {
        constexpr std::uint64_t kMask = (1u << 21) - 1;
        const auto part = [](int i) { return std::uint64_t(i + (1 << 20)) & kMask; };
        return part(cell.x) << 42 | part(cell.y) << 21 | part(cell.z);
    }
    std::size_t endOf(std::size_t cell) const {
        return cell + 1 < cells_.size() ? cells_[cell + 1].first : places_.size();
    }

    void describe(std::size_t index) {
        Cell& cell = cells_[index];
        std::array<float, 2 * kDirections.size()> most;
        most.fill(-std::numeric_limits<float>::infinity());
        for (std::size_t i = cell.first; i < endOf(index); ++i) {
            const glm::vec3 p = vertices_[places_[i].second].position;
            cell.box.add(p);
            for (std::size_t d = 0; d < most.size(); ++d) {
                const float along = glm::dot(p, kDirections[d / 2]) * (d % 2 == 0 ? 1.0f : -1.0f);
                if (along <= most[d]) continue;
                most[d] = along;
                cell.outermost[d] = places_[i].second;
            }
        }
    }

    void listNear(std::size_t index, std::vector<std::uint32_t>& near) const {
        const glm::ivec3 at = cellOf(vertices_[places_[cells_[index].first].second].position);
        const auto key = [&](const Cell& cell) { return places_[cell.first].first; };
        for (int dx = -1; dx <= 1; ++dx)
            for (int dy = -1; dy <= 1; ++dy) { // three cells along z follow on each other
                const std::uint64_t from = keyOf(at + glm::ivec3(dx, dy, -1));
                auto cell = std::ranges::lower_bound(cells_, from, {}, key);
                for (; cell != cells_.end() && key(*cell) <= from + 2; ++cell)
                    near.push_back(std::uint32_t(cell - cells_.begin()));
            }
    }

    bool rises(const DenseVertex& vertex, const Cell& cell) const {
        const float least = 0.04f * reach_; // lower things shade as much as they cover
        const glm::vec3 above =
            glm::mix(cell.box.lower, cell.box.upper, glm::step(glm::vec3(0), vertex.normal));
        if (glm::dot(above - vertex.position, vertex.normal) <= least) return false;
        return std::ranges::any_of(cell.outermost, [&](std::uint32_t v) {
            const glm::vec3 d = vertices_[v].position - vertex.position;
            const float height = glm::dot(d, vertex.normal), far = glm::dot(d, d);
            return height > least && far < reach_ * reach_ && height * height > 0.0625f * far;
        });
    }

    std::span<const DenseVertex> vertices_;
    float reach_;
    std::vector<std::pair<std::uint64_t, std::uint32_t>> places_; ///< key of cell, vertex; sorted
    std::vector<Cell> cells_;                                     ///< by key
};

} // namespace

bool isAlongside(const DenseVertex& a, const DenseVertex& b, float cosine, float slope) {
    const glm::vec3 d = b.position - a.position;
    const float most = slope * glm::length(d);
    return glm::dot(a.normal, b.normal) > cosine && std::abs(glm::dot(a.normal, d)) <= most &&
           std::abs(glm::dot(b.normal, d)) <= most;
}

void chooseReceivers(DenseMesh& mesh, float elementSize) {
    using Role = DenseVertex::Role;
    constexpr float kSlope = 0.2f;
    std::vector<std::uint8_t> flat = smoothVertices(mesh);
    Surroundings(mesh.vertices, 0.5f * elementSize).sift(flat);
    for (std::size_t v = 0; v < flat.size(); ++v) mesh.vertices[v].flat = flat[v] != 0;
    std::vector<std::uint32_t> seenIn(mesh.vertices.size()), receivers;
    for (std::uint32_t c = 0; c + 1 < mesh.firstFace.size(); ++c) {
        const auto faces =
            std::span(mesh.faces)
                .subspan(mesh.firstFace[c], mesh.firstFace[c + 1] - mesh.firstFace[c]);
        receivers.clear();
        for (const auto& face : faces)
            for (const std::uint32_t v : face)
                if (mesh.vertices[v].role == Role::receives &&
                    std::exchange(seenIn[v], 2 * c + 1) != 2 * c + 1)
                    receivers.push_back(v);
        for (const auto& face : faces)
            for (const std::uint32_t v : face) {
                DenseVertex& vertex = mesh.vertices[v];
                if (vertex.role != Role::open || std::exchange(seenIn[v], 2 * c + 2) == 2 * c + 2)
                    continue;
                const float within = vertex.flat ? elementSize : 0.125f * elementSize;
                const auto stands = [&](std::uint32_t other) {
                    const DenseVertex& known = mesh.vertices[other];
                    return (known.flat || !vertex.flat) &&
                           glm::distance(vertex.position, known.position) < within &&
                           isAlongside(vertex, known, kAlike, kSlope);
                };
                if (std::ranges::any_of(receivers, stands)) continue;
                vertex.role = Role::receives;
                receivers.push_back(v);
            }
    }
}

} // namespace penumbra
