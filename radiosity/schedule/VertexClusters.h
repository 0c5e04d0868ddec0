// The blocks of vertices, as clusters that a viewer may see.
#pragma once

#include "base/Rgb.h"
#include "importance/ReceiverClusters.h"
#include "radiosity/mesh/PatchSet.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace penumbra {

/// Neighbouring blocks of vertices of one object make a cluster. How large clusters are and what
/// they reflect is found once; where they are follows the objects.
class VertexClusters {
public:
    /// \param most about how many clusters there are to be. `patches` must outlive this.
    explicit VertexClusters(const PatchSet& patches, std::size_t most = 2000);

    /// Materials reflect other light than before.
    void measure();
    /// Objects were posed anew, hidden or shown.
    void follow(std::span<const ObjectId> objects);

    std::size_t size() const { return clusters_.clusters.size(); }
    /// The cluster of each block; ReceiverClusters::kNowhere for blocks without a surface, and for
    /// those that came later.
    const std::vector<std::uint32_t>& clusterOf() const { return clusters_.clusterOf; }

    /// A cluster in its pose; its luminance is not known.
    const ReceiverCluster& known(std::uint32_t cluster) const {
        return clusters_.clusters[cluster];
    }
    ObjectId objectOf(std::uint32_t cluster) const {
        return patches_.vertexBlockObject[firstBlock_[cluster]];
    }
    /// Around all clusters of some objects [m, world].
    Bounds boundsOf(std::span<const ObjectId> objects) const;
    /// A vertex as a cluster of its own; padding is one without area. \param light its illuminance
    /// [lux]
    ReceiverCluster atVertex(std::size_t vertex, Rgb light) const;
    /// A cluster as it is now. \param light illuminance of the vertices [lux]
    ReceiverCluster at(std::uint32_t index, std::span<const Rgb> light) const;
    /// Up to about eight vertices, spread evenly over a cluster.
    std::vector<std::size_t> spread(std::uint32_t cluster) const;

private:
    void locate(std::uint32_t index);
    template <class Visit>
    void forSome(std::uint32_t cluster, std::size_t most, Visit visit) const;

    const PatchSet& patches_;
    ReceiverClusters clusters_;
    std::vector<float> area_, reflectance_; ///< of vertices that are not private
    std::vector<std::uint32_t> firstBlock_; ///< one a cluster; its blocks are consecutive
};

} // namespace penumbra
