#include "scenegraph/LitGeometry.h"

#include "scenegraph/Visitor.h"

#include <cassert>

namespace penumbra {

LitGeometry::LitGeometry(std::string name, ObjectId object, LitMeshData data)
    : Node(std::move(name)), object_(object), data_(std::move(data)) {
    assert(data_.indices.size() == 3 * data_.triangleMaterial.size());
    for (glm::vec3 position : data_.positions) bounds_.add(position);
}

void LitGeometry::accept(Visitor& visitor) const {
    visitor.visit(*this);
}

void LitGeometry::setIlluminance(std::vector<Rgb> direct, std::vector<Rgb> indirect) {
    assert(direct.size() == data_.positions.size() && indirect.size() == data_.positions.size());
    data_.direct = std::move(direct);
    data_.indirect = std::move(indirect);
    touch();
}

} // namespace penumbra
