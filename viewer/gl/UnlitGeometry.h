// Meshes and lights in the memory of the graphics card, before they are lit.
#pragma once

#include "radiosity/mesh/FaceTriangles.h"
#include "scenegraph/Node.h"
#include "viewer/gl/GeometryCache.h"
#include "viewer/gl/GlObject.h"
#include "viewer/preview/DrawList.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

namespace penumbra {

struct MeshData;

/// One mesh or light, ready to be drawn: positions and texture coordinates; the shader finds the
/// normals.
class UnlitGeometry {
public:
    explicit UnlitGeometry(const MeshData& mesh);

    void bind() const;
    const std::vector<MaterialRange>& ranges() const { return ranges_; }

private:
    GlObject vertexArray_, positions_, uvs_, indices_;
    std::vector<MaterialRange> ranges_;
};

/// Uploads each mesh and light once; their geometry never changes. What is gone is dropped.
class UnlitCache {
public:
    void dropDead();
    const UnlitGeometry& get(const UnlitItem& item);
    std::size_t size() const { return entries_.size(); }

private:
    struct Entry {
        std::weak_ptr<const Node> alive;
        UnlitGeometry gpu;
    };
    std::unordered_map<const Node*, Entry> entries_;
};

} // namespace penumbra
