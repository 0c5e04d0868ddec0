// Blocks of receivers, put together into a few clusters.
#pragma once

#include "importance/Priority.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace penumbra {

/// Blocks that lie together and count as one: so the cost of ordering work anew goes with the
/// number of clusters, however fine the scene is meshed.
struct ReceiverClusters {
    static constexpr std::uint32_t kNowhere = ~std::uint32_t(0);

    std::vector<std::uint32_t> clusterOf; ///< one a block; kNowhere for a block without a surface
    std::vector<std::uint32_t> blocks;    ///< how many in each cluster
    std::vector<ReceiverCluster>
        clusters; ///< what an average block of each is like, in the box of all

    /// Means over the blocks of each cluster, as of pixels seen.
    std::vector<float> mean(std::span<const float> blockValues) const;
};

/// Runs of consecutive blocks of one object, all of about one length, so that there are about
/// `most` clusters, and at least one an object.
/// \param blocks  those of one object are consecutive and near each other; an empty box is no
///                surface
/// \param objects one a block
ReceiverClusters clusterBlocks(std::span<const ReceiverCluster> blocks,
                               std::span<const std::uint32_t> objects, std::size_t most = 2000);

} // namespace penumbra
