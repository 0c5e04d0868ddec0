#include "importance/PlaceClusters.h"

#include <algorithm>
#include <cassert>

namespace penumbra {

namespace {

/// Adds a block to the sums of a place. What is a mean later is weighted by area.
void add(WorkPlace& sum, const WorkPlace& block) {
    sum.box.add(block.box);
    sum.normal += block.area * block.normal;
    sum.luminance += block.area * block.luminance;
    sum.reflectance += block.area * block.reflectance;
    sum.area += block.area;
}

void divide(WorkPlace& sum, std::uint32_t blocks) {
    if (sum.area > 0) {
        sum.normal /= sum.area;
        sum.luminance /= sum.area;
        sum.reflectance /= sum.area;
    }
    sum.area /= float(blocks);
}

} // namespace

std::vector<float> PlaceClusters::mean(std::span<const float> blockValues) const {
    assert(blockValues.size() == placeOf.size());
    std::vector<float> means(places.size());
    for (std::size_t b = 0; b < placeOf.size(); ++b)
        if (placeOf[b] != kNowhere) means[placeOf[b]] += blockValues[b];
    for (std::size_t p = 0; p < means.size(); ++p) means[p] /= float(blocks[p]);
    return means;
}

PlaceClusters clusterBlocks(std::span<const WorkPlace> blocks,
                            std::span<const std::uint32_t> objects, std::size_t most) {
    assert(blocks.size() == objects.size() && most > 0);
    PlaceClusters clusters;
    clusters.placeOf.assign(blocks.size(), PlaceClusters::kNowhere);
    const auto length = std::uint32_t((blocks.size() + most - 1) / most);
    std::uint32_t object = 0;
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        if (blocks[b].box.empty()) continue;
        if (clusters.places.empty() || objects[b] != object || clusters.blocks.back() == length) {
            clusters.places.emplace_back();
            clusters.blocks.push_back(0);
            object = objects[b];
        }
        add(clusters.places.back(), blocks[b]);
        ++clusters.blocks.back();
        clusters.placeOf[b] = std::uint32_t(clusters.places.size() - 1);
    }
    for (std::size_t p = 0; p < clusters.places.size(); ++p)
        divide(clusters.places[p], clusters.blocks[p]);
    return clusters;
}

} // namespace penumbra
