// Meshes and lights in the memory of the graphics card, before they are lit.
#pragma once

#include "radiosity/surface/FaceTriangles.h"
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

/// The normals of a mesh as its front is shaded, one a corner: those of the file, the face's own
/// where it has none, opposite ones where all of a face point away from its front (LimitSurface
/// says the same). Empty if the file has none: faces are flat.
std::vector<glm::vec3> frontNormals(const MeshData& mesh);

/// One mesh or light, ready to be drawn: positions, normals of the file and texture coordinates.
/// Where there are no normals, the shader finds those of the faces.
class UnlitGeometry {
public:
    explicit UnlitGeometry(const MeshData& mesh);

    void bind() const;
    const std::vector<MaterialRange>& ranges() const { return ranges_; }

private:
    GlObject vertexArray_, positions_, normals_, uvs_, indices_;
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
