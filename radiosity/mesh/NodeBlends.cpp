#include "radiosity/mesh/NodeBlends.h"

#include "base/Parallel.h"
#include "radiosity/clusters/DenseReceivers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <optional>
#include <utility>
#include <vector>

namespace penumbra {

namespace {

constexpr float kLeastCosine = 0.5f; ///< between normals: what lies beyond a crease does not count

/// A corner of a cluster's elements, and the cluster.
struct Corner {
    std::array<float, 3> place;
    std::uint32_t patch;
    auto operator<=>(const Corner&) const = default;
};

std::vector<Corner> cornersInOrder(const PatchSet& set) {
    std::vector<Corner> corners;
    for (std::uint32_t p = 0; p < set.patches.size(); ++p) {
        const Patch& patch = set.patches[p];
        for (std::uint32_t i = 0; patch.cluster && i < patch.elementCount; ++i)
            for (std::uint32_t v :
                 set.elements[set.patchElements[patch.firstElement + i]].vertices) {
                const glm::vec3 at = set.vertices[v].position;
                corners.push_back({{at.x, at.y, at.z}, p});
            }
    }
    std::sort(corners.begin(), corners.end());
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    return corners;
}

/// Fills in which clusters of an object touch each other.
void listNear(PatchSet& set) {
    const std::vector<Corner> corners = cornersInOrder(set);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
    for (auto first = corners.begin(); first != corners.end();) {
        const auto last = std::find_if(first, corners.end(),
                                       [&](const Corner& c) { return c.place != first->place; });
        for (auto a = first; a != last; ++a)
            for (auto b = first; b != last; ++b)
                if (a != b && set.patches[a->patch].object == set.patches[b->patch].object)
                    pairs.emplace_back(a->patch, b->patch);
        first = last;
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    for (const auto& [patch, near] : pairs) {
        Patch& of = set.patches[patch];
        if (of.nearCount++ == 0) of.firstNear = std::uint32_t(set.nearClusters.size());
        set.nearClusters.push_back(near);
    }
}

/// How far a node or a receiver is from a vertex, and which it is.
using Near = std::pair<float, std::uint32_t>;

struct Blend {
    std::array<std::uint32_t, 4> things{};
    std::array<float, 4> weights{};
};

Blend blendOf(std::vector<Near>& near, float size) {
    constexpr std::size_t kKnown = 5; // those that count, and the one where weights are 0
    const auto known = near.begin() + std::ptrdiff_t(std::min(near.size(), kKnown));
    std::partial_sort(near.begin(), known, near.end());
    Blend blend;
    const std::size_t count = std::min(near.size(), blend.things.size());
    const float last = near[count - 1].first;
    const float reach =
        std::max(near.size() > count ? near[count].first : 1.5f * last, 1.01f * last);
    float sum = 0;
    for (std::size_t k = 0; k < count; ++k) {
        const float d = std::max(near[k].first, 1e-3f * size);
        const float weight = std::max(reach - d, 0.0f) / (reach * d);
        blend.things[k] = near[k].second;
        blend.weights[k] = weight * weight;
        sum += blend.weights[k];
    }
    if (!(sum > 0)) blend.weights[0] = sum = 1;
    for (float& weight : blend.weights) weight /= sum;
    return blend;
}

/// Of the clusters around a vertex; nothing if it has one alone.
std::optional<NodeBlend> blendAt(const PatchSet& set, std::uint32_t index,
                                 std::vector<Near>& near) {
    const PatchCoordinate& at = set.vertexCoordinates[index];
    if (at.patch == PatchCoordinate::kNone) return {};
    const auto others = set.clustersNear(set.patches[at.patch]);
    if (others.empty()) return {};
    const Vertex& vertex = set.vertices[index];
    near.clear();
    const auto add = [&](std::uint32_t p) {
        const Receiver& node = set.nodes[set.patches[p].centreNode];
        const float cosine = glm::dot(node.normal, vertex.receiver.normal);
        if (p != at.patch && cosine < kLeastCosine) return;
        near.emplace_back(
            glm::distance(node.position, vertex.position) + 2 * set.patchSize * (1 - cosine), p);
    };
    add(at.patch);
    for (const std::uint32_t p : others) add(p);
    if (near.size() < 2) return {};
    const Blend blend = blendOf(near, set.patchSize);
    return NodeBlend{blend.things, blend.weights};
}

} // namespace

void blendNodes(PatchSet& set) {
    listNear(set);
    std::vector<std::optional<NodeBlend>> found(set.vertexCoordinates.size());
    parallelFor(found.size(), 1024, [&](std::size_t first, std::size_t last) {
        std::vector<Near> near;
        for (std::size_t v = first; v < last; ++v) found[v] = blendAt(set, std::uint32_t(v), near);
    });
    for (std::size_t v = 0; v < found.size(); ++v) {
        if (!found[v]) continue;
        set.vertexCoordinates[v].blend = std::uint32_t(set.blends.size());
        set.blends.push_back(*found[v]);
    }
}

namespace {

/// Receivers of each cluster.
std::vector<std::vector<std::uint32_t>> receiversOfClusters(const PatchSet& set) {
    std::vector<std::vector<std::uint32_t>> receivers(set.patches.size());
    for (std::uint32_t v = 0; v < set.vertices.size(); ++v) {
        const std::uint32_t patch = set.vertexCoordinates[v].patch;
        if (patch == PatchCoordinate::kNone || !set.patches[patch].cluster) continue;
        if (!set.isBlended(v / PatchSet::kBlock)) receivers[patch].push_back(v);
    }
    return receivers;
}

} // namespace

void blendVertices(PatchSet& set, std::span<const std::uint8_t> flat) {
    constexpr float kBeside = 0.9f, kSlope = 0.25f; // as receivers are chosen, or more
    if (set.vertexBlends.empty()) return;
    const std::vector<std::vector<std::uint32_t>> receivers = receiversOfClusters(set);
    parallelFor(set.vertices.size(), 1024, [&](std::size_t first, std::size_t last) {
        std::vector<Near> near;
        for (std::size_t v = first; v < last; ++v) {
            const std::uint32_t own = set.vertexCoordinates[v].patch;
            const std::uint32_t block = std::uint32_t(v) / PatchSet::kBlock;
            if (!set.isBlended(block) || own == PatchCoordinate::kNone) continue;
            const Vertex& vertex = set.vertices[v];
            const float farthest = (flat[v] != 0 ? 1.5f : 0.5f) * set.elementSize;
            near.clear();
            const auto add = [&](std::uint32_t patch) {
                for (const std::uint32_t r : receivers[patch]) {
                    const Vertex& other = set.vertices[r];
                    const float away = glm::distance(other.position, vertex.position);
                    if (away > farthest || flat[r] < flat[v]) continue;
                    if (!isAlongside({vertex.position, vertex.receiver.normal},
                                     {other.position, other.receiver.normal}, kBeside, kSlope))
                        continue;
                    const float cosine = glm::dot(other.receiver.normal, vertex.receiver.normal);
                    near.emplace_back(away + 2 * set.elementSize * (1 - cosine), r);
                }
            };
            add(own);
            for (const std::uint32_t p : set.clustersNear(set.patches[own])) add(p);
            if (near.empty()) continue;
            const Blend blend = blendOf(near, set.elementSize);
            set.vertexBlends[set.blockBlends[block] + v % PatchSet::kBlock] = {blend.things,
                                                                               blend.weights};
        }
    });
}

} // namespace penumbra
