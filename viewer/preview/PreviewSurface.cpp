#include "viewer/preview/PreviewSurface.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

namespace penumbra {

namespace {

/// An element's triangles are those of its corners 0 1 2 and 0 2 3, or the first alone.
constexpr std::array<std::uint32_t, 6> kCorners{0, 1, 2, 0, 2, 3};

std::uint32_t entryCount(const std::array<std::uint32_t, 4>& element) {
    return element[2] == element[3] ? 3 : 6;
}

} // namespace

bool PreviewSurface::fits(const LitGeometry& geometry, const PreviewScene& stage,
                          std::uint32_t object) {
    std::size_t entries = 0;
    for (const Element& element : stage.elements(object)) entries += entryCount(element.vertices);
    return entries == geometry.data().indices.size() &&
           stage.vertices(object) <= geometry.data().positions.size();
}

PreviewSurface::PreviewSurface(std::shared_ptr<const LitGeometry> geometry,
                               const PreviewScene& stage, std::uint32_t object)
    : geometry_(std::move(geometry)), ownVertices_(stage.vertices(object)) {
    const LitMeshData& data = geometry_->data();
    blocks_.resize(ownVertices_ / kBlock);
    std::vector<std::uint64_t> used(blocks_.size());
    const std::uint32_t first = stage.firstVertex(object);
    std::uint32_t entry = 0;
    for (const Element& element : stage.elements(object)) {
        std::array<std::uint32_t, 4> own = element.vertices;
        for (std::uint32_t& v : own) {
            v -= first;
            blocks_[v / kBlock].add(data.positions[v]);
            used[v / kBlock] |= std::uint64_t(1) << v % kBlock;
        }
        elements_.push_back(own);
        largestElement_ = std::max(largestElement_,
                                   elementBox(4 * std::uint32_t(elements_.size() - 1)).diagonal());
        firstEntry_.push_back(entry);
        entry += entryCount(own);
    }
    for (std::size_t b = 0; b < blocks_.size(); ++b)
        coarse_.push_back(coarseBlock(std::span(data.positions).subspan(b * kBlock, kBlock),
                                      std::span(data.normals).subspan(b * kBlock, kBlock),
                                      used[b]));
    findSources(stage, object);
}

void PreviewSurface::findSources(const PreviewScene& stage, std::uint32_t object) {
    sources_.resize(blocks_.size());
    for (std::uint32_t b = 0; b < blocks_.size(); ++b) {
        if (!stage.isBlended(object, b)) continue;
        std::map<std::uint32_t, std::uint64_t> from;
        for (std::size_t i = 0; i < kBlock; ++i)
            stage.forEachReceiver(object, b * kBlock + i, {}, [&](std::uint32_t v, float) {
                from[v / std::uint32_t(kBlock)] |= std::uint64_t(1) << v % kBlock;
            });
        for (const auto& [block, vertices] : from) sources_[b].push_back({block, vertices});
    }
}

/// Of a bent element it is enough that one corner's normal is turned there.
std::vector<std::uint64_t> PreviewSurface::turnedTo(glm::vec3 eye) const {
    const LitMeshData& data = geometry_->data();
    std::vector<std::uint64_t> seen(blocks_.size());
    for (const auto& element : elements_) {
        const auto turned = [&](std::uint32_t v) {
            return glm::dot(data.normals[v], eye - data.positions[v]) > 0;
        };
        if (std::none_of(element.begin(), element.end(), turned)) continue;
        for (const std::uint32_t v : element) seen[v / kBlock] |= std::uint64_t(1) << v % kBlock;
    }
    return seen;
}

void PreviewSurface::follow() {
    topology_ = geometry_->topologyRevision();
    standIns_.clear();
    const std::vector<std::uint32_t>& indices = geometry_->data().indices;
    for (std::uint32_t e = 0; e < elements_.size(); ++e)
        for (std::uint32_t i = 0; i < entryCount(elements_[e]); ++i) {
            const std::uint32_t vertex = indices[firstEntry_[e] + i];
            if (vertex >= ownVertices_) standIns_.push_back({vertex, 4 * e + kCorners[i]});
        }
    std::sort(standIns_.begin(), standIns_.end(),
              [](const StandIn& a, const StandIn& b) { return a.vertex < b.vertex; });
    const auto same = [](const StandIn& a, const StandIn& b) { return a.vertex == b.vertex; };
    standIns_.erase(std::unique(standIns_.begin(), standIns_.end(), same), standIns_.end());
}

std::optional<std::uint32_t> PreviewSurface::cornerOf(std::size_t vertex) const {
    const auto found =
        std::lower_bound(standIns_.begin(), standIns_.end(), vertex,
                         [](const StandIn& s, std::size_t v) { return s.vertex < v; });
    if (found == standIns_.end() || found->vertex != vertex) return std::nullopt;
    return found->corner;
}

std::uint32_t PreviewSurface::ownVertexAt(std::uint32_t corner) const {
    return elements_[corner / 4][corner % 4];
}

std::uint32_t PreviewSurface::drawnAt(std::uint32_t corner) const {
    return geometry_->data().indices[entriesOf(corner).front()];
}

std::vector<std::uint32_t> PreviewSurface::entriesOf(std::uint32_t corner) const {
    std::vector<std::uint32_t> entries;
    for (std::uint32_t i = 0; i < entryCount(elements_[corner / 4]); ++i)
        if (kCorners[i] == corner % 4) entries.push_back(firstEntry_[corner / 4] + i);
    return entries;
}

Bounds PreviewSurface::elementBox(std::uint32_t corner) const {
    Bounds box;
    for (const std::uint32_t v : elements_[corner / 4]) box.add(geometry_->data().positions[v]);
    return box;
}

} // namespace penumbra
