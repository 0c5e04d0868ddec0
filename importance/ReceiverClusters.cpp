#include "importance/ReceiverClusters.h"

#include <algorithm>
#include <cassert>

namespace penumbra {

namespace {

/// Adds a block to the sums of a cluster. What is a mean later is weighted by area.
void add(ReceiverCluster& sum, const ReceiverCluster& block) {
    sum.box.add(block.box);
    sum.normal += block.area * block.normal;
    sum.luminance += block.area * block.luminance;
    sum.reflectance += block.area * block.reflectance;
    sum.area += block.area;
}

void divide(ReceiverCluster& sum, std::uint32_t blocks) {
    if (sum.area > 0) {
        sum.normal /= sum.area;
        sum.luminance /= sum.area;
        sum.reflectance /= sum.area;
    }
    sum.area /= float(blocks);
}

} // namespace

std::vector<float> ReceiverClusters::mean(std::span<const float> blockValues) const {
    assert(blockValues.size() == clusterOf.size());
    std::vector<float> means(clusters.size());
    for (std::size_t b = 0; b < clusterOf.size(); ++b)
        if (clusterOf[b] != kNowhere) means[clusterOf[b]] += blockValues[b];
    for (std::size_t p = 0; p < means.size(); ++p) means[p] /= float(blocks[p]);
    return means;
}

ReceiverClusters clusterBlocks(std::span<const ReceiverCluster> blocks,
                               std::span<const std::uint32_t> objects, std::size_t most) {
    assert(blocks.size() == objects.size() && most > 0);
    ReceiverClusters clusters;
    clusters.clusterOf.assign(blocks.size(), ReceiverClusters::kNowhere);
    const auto length = std::uint32_t((blocks.size() + most - 1) / most);
    std::uint32_t object = 0;
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        if (blocks[b].box.empty()) continue;
        if (clusters.clusters.empty() || objects[b] != object || clusters.blocks.back() == length) {
            clusters.clusters.emplace_back();
            clusters.blocks.push_back(0);
            object = objects[b];
        }
        add(clusters.clusters.back(), blocks[b]);
        ++clusters.blocks.back();
        clusters.clusterOf[b] = std::uint32_t(clusters.clusters.size() - 1);
    }
    for (std::size_t p = 0; p < clusters.clusters.size(); ++p)
        divide(clusters.clusters[p], clusters.blocks[p]);
    return clusters;
}

} // namespace penumbra
