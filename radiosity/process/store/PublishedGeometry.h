// A lit surface as the worker publishes it: with what single lights have in its light.
#pragma once

#include "scenegraph/LitGeometry.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace penumbra {

/// What has to do with one light alone, for those who exchange its light for a faster estimate.
struct LightShare {
    enum class Known : std::uint8_t {
        no,    ///< the factors of this block have not come yet
        stale, ///< an edit may still change some of them, or what other lights give there
        exact  ///< both are those of the scene (but see RadiosityState::dirtyMarked)
    };
    /// Illuminance by this light over its exitance pi L: F V, no unit; one a vertex.
    std::vector<float> factor;
    std::vector<Known> known; ///< one a block, see LitGeometry::kBlock
    /// One a block [lm/m^2]: factor * exitance is what `direct` has of this light, however bright
    /// it may be by now.
    std::vector<Rgb> exitance;
};
using LightShares = std::vector<LightShare>;

/// Of so many lights, on so many vertices: nothing is known.
LightShares unknownShares(std::size_t lights, std::size_t vertices);
/// Makes room for vertices that have been added.
void growShares(LightShares& shares, std::size_t vertices);

/// A LitGeometry with the shares of the lights that preview lighting may exchange.
class PublishedGeometry final : public LitGeometry {
public:
    /// \param shares of as many vertices
    PublishedGeometry(std::string name, ObjectId object, LitMeshData data, LightShares shares = {});

    const LightShares& shares() const { return shares_; }
    /// From now on there are so many lights; nothing is known of them.
    void setLights(std::size_t count);
    using LitGeometry::setBlock;
    /// The same, with the shares.
    void setBlock(std::size_t block, const std::function<void(LitMeshData&, LightShares&)>& edit);
    /// As LitGeometry::setTopology(); the shares grow with the vertices.
    void setTopology(const std::function<void(LitMeshData&)>& edit);

private:
    LightShares shares_;
};

} // namespace penumbra
