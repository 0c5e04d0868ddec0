// One lit surface as preview rays see it: its blocks, and which vertices represent touched corners.
#pragma once

#include "base/Bounds.h"
#include "radiosity/clusters/CoarseBlock.h"
#include "scenegraph/LitGeometry.h"
#include "viewer/preview/PreviewScene.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace penumbra {

/// Follows how a LitGeometry is drawn: the vertices that it has from the start lie in blocks, those
/// behind them represent single corners of elements that something touches (see LitObjects), now
/// for one and later for another.
class PreviewSurface {
public:
    static constexpr std::size_t kBlock = LitGeometry::kBlock;

    PreviewSurface() = default;
    /// Whether an object's patches are those of a geometry. They come from another process, each at
    /// its own time.
    static bool fits(const LitGeometry& geometry, const PreviewScene& stage, std::uint32_t object);
    /// \pre fits()
    PreviewSurface(std::shared_ptr<const LitGeometry> geometry, const PreviewScene& stage,
                   std::uint32_t object);

    const std::shared_ptr<const LitGeometry>& geometry() const { return geometry_; }
    explicit operator bool() const { return geometry_ != nullptr; }
    /// Whether triangles are made of other vertices than when this was asked last.
    bool isCurrent() const { return topology_ == geometry_->topologyRevision(); }
    void follow();

    std::size_t ownVertices() const { return ownVertices_; }
    /// Boxes of blocks of the vertices from the start, empty ones left out [m, local].
    std::span<const Bounds> blocks() const { return blocks_; }
    std::span<const CoarseBlock> coarse() const { return coarse_; } ///< as blocks()
    /// Vertices of a block from which those of a blended one take their light (see PatchSet).
    struct Source {
        std::uint32_t block = 0;
        std::uint64_t vertices = 0; ///< a bit each
    };
    std::span<const Source> sourcesOf(std::uint32_t block) const { return sources_[block]; }
    /// Diagonal of an element's box, at most [m, local].
    float largestElement() const { return largestElement_; }
    /// Vertices from the start that have an element which does not turn its back on a point: one
    /// bit each, a word a block. \param eye [m, local]
    std::vector<std::uint64_t> turnedTo(glm::vec3 eye) const;
    /// A vertex behind those from the start, and what it represents.
    struct StandIn {
        std::uint32_t vertex = 0, corner = 0; ///< see TouchedCorner
    };
    std::span<const StandIn> standIns() const { return standIns_; } ///< by vertex
    std::optional<std::uint32_t> cornerOf(std::size_t vertex) const;

    /// The vertex from the start that a corner has when nothing touches it.
    std::uint32_t ownVertexAt(std::uint32_t corner) const;
    /// The vertex that is drawn at a corner.
    std::uint32_t drawnAt(std::uint32_t corner) const;
    /// Where a corner occurs in LitMeshData::indices: once or twice.
    std::vector<std::uint32_t> entriesOf(std::uint32_t corner) const;
    /// Around the element of a corner [m, local].
    Bounds elementBox(std::uint32_t corner) const;

private:
    void findSources(const PreviewScene& stage, std::uint32_t object);

    std::shared_ptr<const LitGeometry> geometry_;
    std::uint64_t topology_ = 0;
    std::size_t ownVertices_ = 0;
    std::vector<std::array<std::uint32_t, 4>> elements_; ///< of vertices from the start
    std::vector<std::uint32_t> firstEntry_;              ///< of each element, in the indices
    std::vector<Bounds> blocks_;
    std::vector<CoarseBlock> coarse_;
    std::vector<std::vector<Source>> sources_; ///< as blocks(); none: a block has receivers
    float largestElement_ = 0;
    std::vector<StandIn> standIns_;
};

} // namespace penumbra
