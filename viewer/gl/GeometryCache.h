// Lit surfaces in the memory of the graphics card.
#pragma once

#include "base/Bounds.h"
#include "base/Rgb.h"
#include "radiosity/surface/FaceTriangles.h"
#include "scenegraph/Node.h"
#include "viewer/gl/GlObject.h"
#include "viewer/preview/DrawList.h"
#include "viewer/preview/ShownLight.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

namespace penumbra {

struct LitMeshData;

/// Some triangles of a range that lie together.
struct TriangleChunk {
    std::size_t range = 0; ///< index of its MaterialRange
    std::size_t firstIndex = 0;
    std::size_t indexCount = 0;
    Bounds bounds; ///< [m, local frame]
};

/// One LitGeometry, ready to be drawn.
class GpuGeometry {
public:
    /// \param shown its light as it is to be shown; null: its own \param factors with the factors
    /// of previewed lights, if they are known
    GpuGeometry(const LitGeometry& geometry, const ShownLight* shown, bool factors);

    /// Copies the light of those blocks again that were edited since; returns how many bytes.
    std::size_t refresh(const LitGeometry& geometry, const ShownLight* shown, bool factors);

    /// Whether its triangles are still those of the geometry.
    bool sameTopology(const LitGeometry& geometry) const;

    void bind() const;
    const std::vector<MaterialRange>& ranges() const { return ranges_; }
    /// All triangles in their order, cut into runs of one range that lie together.
    const std::vector<TriangleChunk>& chunks() const { return chunks_; }

private:
    void makeBuffers(const LitGeometry& geometry, const ShownLight* shown);
    std::size_t copyIndirect(const ShownLight* shown, const LitGeometry& geometry,
                             std::size_t first, std::size_t count);
    std::size_t copyOthers(const ShownLight* shown, const LitGeometry& geometry, std::size_t first,
                           std::size_t count);
    std::size_t splitCorners(const LitGeometry& geometry, const SplitCorners& corners);
    void placeEntries(const LitMeshData& mesh);
    std::size_t writeEntry(std::uint32_t entry, std::uint32_t vertex);
    void dropFactors();
    void requireFactors(const ShownLight* shown, bool wanted);

    GlObject vertexArray_, positions_, normals_, direct_, indirect_, uvs_, indices_;
    GlObject factors_, behind_; ///< of previewed lights, when there first are any
    std::size_t room_ = 0;      ///< for vertices
    std::vector<MaterialRange> ranges_;
    std::vector<TriangleChunk> chunks_;
    std::vector<std::uint32_t> trianglePlaces_; ///< in indices_; empty: not needed so far
    SplitCorners corners_;                      ///< that are in the buffers
    const ShownLight* shown_ = nullptr; ///< what light is in the buffers; only to be compared
    std::uint64_t revision_ = 0, topologyRevision_ = 0;
    std::vector<std::uint64_t> blockRevisions_; ///< of the light that is in the buffers
};

/// Uploads each geometry once, and afterwards only its light when that has changed. A geometry that
/// is gone from memory is dropped; until then it may leave the view, or the graph, and come back
/// for free.
class GeometryCache {
public:
    /// Drops what no longer exists.
    void dropDead();
    /// Whether what is got from now on has the factors of previewed lights, for MapPreview.
    void needFactors(bool needed) { factors_ = needed; }

    /// The geometry with its present light.
    const GpuGeometry& get(const DrawItem& item);
    /// The same of one that is not in a list. \param owner of the geometry
    const GpuGeometry& get(const LitGeometry& geometry, const ShownLight* shown,
                           const std::weak_ptr<const Node>& owner);
    /// Its triangles, whatever its light is.
    const GpuGeometry& peek(const std::shared_ptr<const LitGeometry>& geometry);

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
    bool factors_ = false;
    std::size_t uploads_ = 0;
    std::size_t lightUploads_ = 0;
    std::size_t lightBytes_ = 0;
};

} // namespace penumbra
