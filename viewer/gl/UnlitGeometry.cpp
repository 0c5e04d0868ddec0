#include "viewer/gl/UnlitGeometry.h"

#include "radiosity/mesh/LightShapes.h"
#include "scenegraph/Light.h"
#include "scenegraph/Mesh.h"
#include "viewer/gl/Shaders.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <span>

namespace penumbra {

namespace {

template <class T>
GlObject filledBuffer(GLenum target, const std::vector<T>& values) {
    GlObject buffer = makeBuffer();
    glBindBuffer(target, buffer.name());
    glBufferData(target, GLsizeiptr(values.size() * sizeof(T)), values.data(), GL_STATIC_DRAW);
    return buffer;
}

/// The same faces with a point of its own for each corner.
MeshData byCorners(const MeshData& mesh) {
    MeshData corners;
    corners.faceVertexCounts = mesh.faceVertexCounts;
    corners.holes = mesh.holes;
    corners.materials = mesh.materials;
    corners.faceMaterial = mesh.faceMaterial;
    for (const std::int32_t point : mesh.faceVertexIndices) {
        corners.faceVertexIndices.push_back(std::int32_t(corners.points.size()));
        corners.points.push_back(mesh.points[std::size_t(point)]);
    }
    return corners;
}

} // namespace

UnlitGeometry::UnlitGeometry(const MeshData& mesh) : vertexArray_(makeVertexArray()) {
    const bool textured = !mesh.uvs.empty();
    const MeshData corners = textured ? byCorners(mesh) : MeshData();
    FaceTriangles triangles = faceTriangles(textured ? corners : mesh);
    ranges_ = std::move(triangles.ranges);
    glBindVertexArray(vertexArray_.name());
    positions_ = filledBuffer(GL_ARRAY_BUFFER, textured ? corners.points : mesh.points);
    glVertexAttribPointer(kPosition, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
    glEnableVertexAttribArray(kPosition);
    if (textured) {
        uvs_ = filledBuffer(GL_ARRAY_BUFFER, mesh.uvs);
        glVertexAttribPointer(kUv, 2, GL_FLOAT, GL_FALSE, 0, nullptr);
        glEnableVertexAttribArray(kUv);
    }
    indices_ = filledBuffer(GL_ELEMENT_ARRAY_BUFFER, triangles.indices);
    glBindVertexArray(0);
}

void UnlitGeometry::bind() const {
    glBindVertexArray(vertexArray_.name());
}

void UnlitCache::dropDead() {
    std::erase_if(entries_, [](const auto& entry) { return entry.second.alive.expired(); });
}

const UnlitGeometry& UnlitCache::get(const UnlitItem& item) {
    const Node& node = item.mesh ? static_cast<const Node&>(*item.mesh) : *item.light;
    const auto found = entries_.find(&node);
    if (found != entries_.end()) return found->second.gpu;
    Entry entry{ownerOf(*item.parent, node),
                UnlitGeometry(item.mesh ? item.mesh->data() : lightShapeMesh(*item.light))};
    return entries_.emplace(&node, std::move(entry)).first->second.gpu;
}

} // namespace penumbra
