// Lit surfaces in the memory of the graphics card.
#pragma once

#include "scenegraph/Node.h"
#include "viewer/DrawList.h"
#include "viewer/GlObject.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

namespace penumbra {

/// A run of a geometry's triangles that share a material.
struct MaterialRange {
    std::uint32_t material = 0; ///< index into LitMeshData::materials
    std::size_t firstIndex = 0;
    std::size_t indexCount = 0;
};

/// One LitGeometry, ready to be drawn.
class GpuGeometry {
public:
    explicit GpuGeometry(const LitGeometry& geometry);

    /// Copies the light of those blocks again that were edited since; returns how many bytes.
    /// \param now [s]
    std::size_t refresh(const LitGeometry& geometry, double now);

    /// Whether its triangles are still those of the geometry.
    bool sameTopology(const LitGeometry& geometry) const;

    void bind() const;
    const std::vector<MaterialRange>& ranges() const { return ranges_; }
    /// When the light of each block was copied last, by the time given to refresh() [s].
    const std::vector<float>& blockTimes() const { return blockTimes_; }

private:
    GlObject vertexArray_, positions_, normals_, direct_, indirect_, indices_;
    std::vector<MaterialRange> ranges_;
    std::uint64_t revision_ = 0, topologyRevision_ = 0;
    std::vector<std::uint64_t> blockRevisions_; ///< of the light that is in the buffers
    std::vector<float> blockTimes_;
};

/// Uploads each geometry once, and afterwards only its light when that has changed. A geometry that
/// is gone from memory is dropped; until then it may leave the view, or the graph, and come back
/// for free.
class GeometryCache {
public:
    /// Drops what no longer exists. To be called before each frame. \param now its time [s]
    void dropDead(double now = 0);

    /// The geometry with its present light.
    const GpuGeometry& get(const DrawItem& item);

    std::size_t uploads() const { return uploads_; }           ///< of whole geometries, ever
    std::size_t lightUploads() const { return lightUploads_; } ///< of light alone, ever
    std::size_t lightBytes() const { return lightBytes_; }     ///< of these, ever
    std::size_t size() const { return entries_.size(); }

private:
    struct Entry {
        std::weak_ptr<const Node> alive; ///< an address alone might be that of a later node
        GpuGeometry gpu;
    };

    std::unordered_map<const LitGeometry*, Entry> entries_;
    std::size_t uploads_ = 0;
    std::size_t lightUploads_ = 0;
    std::size_t lightBytes_ = 0;
    double now_ = 0;
};

} // namespace penumbra
