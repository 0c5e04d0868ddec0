#include "scenegraph/Mesh.h"

#include "scenegraph/Visitor.h"

#include <cassert>

namespace penumbra {

Mesh::Mesh(std::string name, MeshData data) : Node(std::move(name)), data_(std::move(data)) {
    assert(!data_.materials.empty());
    assert(data_.normals.empty() || data_.normals.size() == data_.faceVertexIndices.size());
    assert(data_.faceMaterial.empty() || data_.faceMaterial.size() == faceCount());
    assert(data_.uvs.empty() || data_.uvs.size() == data_.faceVertexIndices.size());
    for (glm::vec3 point : data_.points) bounds_.add(point);
}

void Mesh::accept(Visitor& visitor) const {
    visitor.visit(*this);
}

} // namespace penumbra
