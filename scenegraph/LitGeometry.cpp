#include "scenegraph/LitGeometry.h"

#include "scenegraph/Visitor.h"

#include <cassert>

namespace penumbra {

namespace {

std::size_t blocksOf(const LitMeshData& data) {
    return (data.positions.size() + LitGeometry::kBlock - 1) / LitGeometry::kBlock;
}

} // namespace

LitGeometry::LitGeometry(std::string name, ObjectId object, LitMeshData data)
    : Node(std::move(name)), object_(object), data_(std::move(data)),
      blockRevisions_(blocksOf(data_), 1) {
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
    touchBlocks();
}

void LitGeometry::setBlock(std::size_t block, const std::function<void(LitMeshData&)>& edit) {
    edit(data_);
    ++blockRevisions_[block];
    touch();
}

void LitGeometry::setTopology(const std::function<void(LitMeshData&)>& edit) {
    const std::size_t before = data_.positions.size();
    edit(data_);
    assert(data_.indices.size() == 3 * data_.triangleMaterial.size());
    assert(data_.positions.size() >= before && data_.direct.size() == data_.positions.size());
    for (std::size_t v = before; v < data_.positions.size(); ++v) bounds_.add(data_.positions[v]);
    blockRevisions_.resize(blocksOf(data_), 1);
    ++topologyRevision_;
    touch();
}

void LitGeometry::touchBlocks() {
    for (std::uint64_t& revision : blockRevisions_) ++revision;
    touch();
}

void LitGeometry::setMaterials(std::vector<LitMaterial> materials) {
    if (materials == data_.materials) return;
    data_.materials = std::move(materials);
    touch();
}

} // namespace penumbra
