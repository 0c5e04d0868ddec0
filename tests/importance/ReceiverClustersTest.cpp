// Blocks of receivers, put together into a few clusters.
#include "importance/ReceiverClusters.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace penumbra {

namespace {

using testing::ElementsAre;

ReceiverCluster blockAt(float x, glm::vec3 normal = {0, 0, 1}, float area = 1) {
    ReceiverCluster block;
    block.box = {{x, 0, 0}, {x + 1, 1, 0}};
    block.normal = normal;
    block.area = area;
    block.luminance = x;
    block.reflectance = 0.5f;
    return block;
}

TEST(ClusterBlocks, PutsNeighboursOfOneObjectTogether) {
    const std::vector<ReceiverCluster> blocks{blockAt(0), blockAt(1), blockAt(2), blockAt(3),
                                              blockAt(4)};
    const std::vector<std::uint32_t> objects{7, 7, 7, 9, 9};
    const ReceiverClusters clusters = clusterBlocks(blocks, objects, 3); // two at a time
    EXPECT_THAT(clusters.clusterOf, ElementsAre(0, 0, 1, 2, 2));
    EXPECT_THAT(clusters.blocks, ElementsAre(2, 1, 2));
    EXPECT_EQ(clusters.clusters[0].box.lower.x, 0);
    EXPECT_EQ(clusters.clusters[0].box.upper.x, 2);
}

TEST(ClusterBlocks, LeavesThemAloneWhenTheyAreFew) {
    const std::vector<ReceiverCluster> blocks{blockAt(0), blockAt(1), blockAt(2)};
    const ReceiverClusters clusters = clusterBlocks(blocks, std::vector<std::uint32_t>{1, 1, 1}, 3);
    EXPECT_THAT(clusters.clusterOf, ElementsAre(0, 1, 2));
}

TEST(ClusterBlocks, LeavesOutWhatHasNoSurface) {
    const std::vector<ReceiverCluster> blocks{blockAt(0), ReceiverCluster{}, blockAt(2)};
    const ReceiverClusters clusters = clusterBlocks(blocks, std::vector<std::uint32_t>{1, 1, 1}, 1);
    EXPECT_THAT(clusters.clusterOf, ElementsAre(0, ReceiverClusters::kNowhere, 0));
    EXPECT_THAT(clusters.blocks, ElementsAre(2));
}

TEST(ClusterBlocks, DescribesAnAverageBlock) {
    const std::vector<ReceiverCluster> blocks{blockAt(0, {0, 0, 1}, 1), blockAt(4, {0, 1, 0}, 3)};
    const ReceiverClusters clusters = clusterBlocks(blocks, std::vector<std::uint32_t>{1, 1}, 1);
    const ReceiverCluster& mean = clusters.clusters[0];
    EXPECT_FLOAT_EQ(mean.area, 2);
    EXPECT_FLOAT_EQ(mean.luminance, 3); // by area
    EXPECT_EQ(mean.normal, glm::vec3(0, 0.75f, 0.25f));
    EXPECT_FLOAT_EQ(mean.reflectance, 0.5f);
    EXPECT_THAT(clusters.mean(std::vector<float>{10, 20}), ElementsAre(15));
}

} // namespace

} // namespace penumbra
