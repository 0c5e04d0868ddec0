// Meshes and lights in the memory of the graphics card, before they are lit.
#pragma once

#include "scenegraph/Node.h"
#include "viewer/DrawList.h"
#include "viewer/GeometryCache.h"
#include "viewer/GlObject.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

namespace penumbra {

struct MeshData;

/// The faces of a mesh as triangles, those of one material after those of another; subdivision
/// surfaces as their cages.
struct PreviewTriangles {
    std::vector<std::uint32_t> indices; ///< three a triangle, into MeshData::points
    std::vector<MaterialRange> ranges;  ///< material: index into MeshData::materials
};
PreviewTriangles previewTriangles(const MeshData& mesh);

/// One mesh or light, ready to be drawn: positions alone, the shader finds the normals.
class PreviewGeometry {
public:
    explicit PreviewGeometry(const MeshData& mesh);

    void bind() const;
    const std::vector<MaterialRange>& ranges() const { return ranges_; }

private:
    GlObject vertexArray_, positions_, indices_;
    std::vector<MaterialRange> ranges_;
};

/// Uploads each mesh and light once; their geometry never changes. What is gone is dropped.
class PreviewCache {
public:
    void dropDead();
    const PreviewGeometry& get(const UnlitItem& item);
    std::size_t size() const { return entries_.size(); }

private:
    struct Entry {
        std::weak_ptr<const Node> alive;
        PreviewGeometry gpu;
    };
    std::unordered_map<const Node*, Entry> entries_;
};

} // namespace penumbra
