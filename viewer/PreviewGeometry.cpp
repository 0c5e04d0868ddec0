#include "viewer/PreviewGeometry.h"

#include "radiosity/LightShapes.h"
#include "radiosity/Triangulate.h"
#include "scenegraph/Light.h"
#include "scenegraph/Mesh.h"
#include "viewer/Shaders.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <span>

namespace penumbra {

namespace {

bool isHole(const MeshData& mesh, std::size_t face) {
    return std::find(mesh.holes.begin(), mesh.holes.end(), std::int32_t(face)) != mesh.holes.end();
}

/// Indices of a face's triangles, appended.
void appendFace(const MeshData& mesh, std::size_t first, std::size_t count,
                std::vector<std::uint32_t>& indices) {
    const auto begin = mesh.faceVertexIndices.begin() + std::ptrdiff_t(first);
    const std::vector<std::uint32_t> corners(begin, begin + std::ptrdiff_t(count));
    if (count == 3) {
        indices.insert(indices.end(), corners.begin(), corners.end());
        return;
    }
    for (const auto& triangle : triangulate(mesh.points, corners))
        indices.insert(indices.end(), triangle.begin(), triangle.end());
}

template <class T>
GlObject filledBuffer(GLenum target, const std::vector<T>& values) {
    GlObject buffer = makeBuffer();
    glBindBuffer(target, buffer.name());
    glBufferData(target, GLsizeiptr(values.size() * sizeof(T)), values.data(), GL_STATIC_DRAW);
    return buffer;
}

} // namespace

PreviewTriangles previewTriangles(const MeshData& mesh) {
    std::vector<std::vector<std::uint32_t>> byMaterial(mesh.materials.size());
    std::size_t first = 0;
    for (std::size_t face = 0; face < mesh.faceVertexCounts.size(); ++face) {
        const auto count = std::size_t(mesh.faceVertexCounts[face]);
        const std::size_t material = mesh.faceMaterial.empty() ? 0 : mesh.faceMaterial[face];
        if (!isHole(mesh, face)) appendFace(mesh, first, count, byMaterial[material]);
        first += count;
    }
    PreviewTriangles triangles;
    for (std::size_t material = 0; material < byMaterial.size(); ++material) {
        const std::vector<std::uint32_t>& indices = byMaterial[material];
        if (indices.empty()) continue;
        triangles.ranges.push_back(
            {std::uint32_t(material), triangles.indices.size(), indices.size()});
        triangles.indices.insert(triangles.indices.end(), indices.begin(), indices.end());
    }
    return triangles;
}

PreviewGeometry::PreviewGeometry(const MeshData& mesh) : vertexArray_(makeVertexArray()) {
    PreviewTriangles triangles = previewTriangles(mesh);
    ranges_ = std::move(triangles.ranges);
    glBindVertexArray(vertexArray_.name());
    positions_ = filledBuffer(GL_ARRAY_BUFFER, mesh.points);
    glVertexAttribPointer(kPosition, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
    glEnableVertexAttribArray(kPosition);
    indices_ = filledBuffer(GL_ELEMENT_ARRAY_BUFFER, triangles.indices);
    glBindVertexArray(0);
}

void PreviewGeometry::bind() const {
    glBindVertexArray(vertexArray_.name());
}

void PreviewCache::dropDead() {
    std::erase_if(entries_, [](const auto& entry) { return entry.second.alive.expired(); });
}

const PreviewGeometry& PreviewCache::get(const UnlitItem& item) {
    const Node& node = item.mesh ? static_cast<const Node&>(*item.mesh) : *item.light;
    const auto found = entries_.find(&node);
    if (found != entries_.end()) return found->second.gpu;
    Entry entry{ownerOf(*item.parent, node),
                PreviewGeometry(item.mesh ? item.mesh->data() : lightShapeMesh(*item.light))};
    return entries_.emplace(&node, std::move(entry)).first->second.gpu;
}

} // namespace penumbra
