#include "viewer/gl/UnlitGeometry.h"

#include "radiosity/mesh/Emitters.h"
#include "radiosity/surface/SurfaceMesh.h"
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

void attach(GLuint attribute, GLint components) {
    glVertexAttribPointer(attribute, components, GL_FLOAT, GL_FALSE, 0, nullptr);
    glEnableVertexAttribArray(attribute);
}

} // namespace

std::vector<glm::vec3> frontNormals(const MeshData& mesh) {
    std::vector<glm::vec3> normals = mesh.normals;
    std::size_t first = 0;
    for (const std::int32_t corners : mesh.faceVertexCounts) {
        if (normals.empty()) break;
        const auto count = std::size_t(corners);
        std::vector<std::uint32_t> points;
        for (std::size_t i = first; i < first + count; ++i)
            points.push_back(std::uint32_t(mesh.faceVertexIndices[i]));
        const glm::dvec3 area = newellNormal(mesh.points, points);
        const double length = glm::length(area);
        const glm::vec3 own = length > 0 ? glm::vec3(area / length) : glm::vec3(0);
        const auto here = std::span(normals).subspan(first, count);
        for (glm::vec3& normal : here)
            if (normal == glm::vec3(0)) normal = own;
        if (std::all_of(here.begin(), here.end(), [&](glm::vec3 n) { return dot(n, own) < 0; }))
            for (glm::vec3& normal : here) normal = -normal;
        first += count;
    }
    return normals;
}

UnlitGeometry::UnlitGeometry(const MeshData& mesh) : vertexArray_(makeVertexArray()) {
    const std::vector<glm::vec3> normals = frontNormals(mesh);
    const bool parted = !mesh.uvs.empty() || !normals.empty();
    const MeshData corners = parted ? byCorners(mesh) : MeshData();
    FaceTriangles triangles = faceTriangles(parted ? corners : mesh);
    ranges_ = std::move(triangles.ranges);
    glBindVertexArray(vertexArray_.name());
    positions_ = filledBuffer(GL_ARRAY_BUFFER, parted ? corners.points : mesh.points);
    attach(kPosition, 3);
    if (!normals.empty()) {
        normals_ = filledBuffer(GL_ARRAY_BUFFER, normals);
        attach(kNormal, 3);
    } // else the attribute is (0, 0, 0)
    if (!mesh.uvs.empty()) {
        uvs_ = filledBuffer(GL_ARRAY_BUFFER, mesh.uvs);
        attach(kUv, 2);
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
