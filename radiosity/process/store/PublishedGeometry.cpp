#include "radiosity/process/store/PublishedGeometry.h"

#include <utility>

namespace penumbra {

LightShares unknownShares(std::size_t lights, std::size_t vertices) {
    LightShares shares(lights);
    growShares(shares, vertices);
    return shares;
}

void growShares(LightShares& shares, std::size_t vertices) {
    const std::size_t blocks = (vertices + LitGeometry::kBlock - 1) / LitGeometry::kBlock;
    for (LightShare& share : shares) {
        share.factor.resize(vertices);
        share.known.resize(blocks);
        share.exitance.resize(blocks);
    }
}

PublishedGeometry::PublishedGeometry(std::string name, ObjectId object, LitMeshData data,
                                     LightShares shares)
    : LitGeometry(std::move(name), object, std::move(data)), shares_(std::move(shares)) {}

void PublishedGeometry::setLights(std::size_t count) {
    shares_ = unknownShares(count, data().positions.size());
    touchBlocks();
}

void PublishedGeometry::setBlock(std::size_t block,
                                 const std::function<void(LitMeshData&, LightShares&)>& edit) {
    LitGeometry::setBlock(block, [&](LitMeshData& data) { edit(data, shares_); });
}

void PublishedGeometry::setTopology(const std::function<void(LitMeshData&)>& edit) {
    LitGeometry::setTopology(edit);
    growShares(shares_, data().positions.size());
}

} // namespace penumbra
