// Patches are put together with their like, each once.
#include "radiosity/transport/Clusters.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace penumbra {

namespace {

/// Patches all over the six sides of a box, in no order.
std::vector<ClusterPatch> patchesOfABox(std::uint32_t count) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> any(-1, 1);
    std::vector<ClusterPatch> patches;
    for (std::uint32_t i = 0; i < count; ++i) {
        const int axis = int(i % 3);
        const float side = i % 2 ? 1.0f : -1.0f;
        glm::vec3 centre(any(random), any(random), any(random)), normal(0);
        centre[axis] = normal[axis] = side;
        patches.push_back({i, centre, normal, 0.1f + 0.1f * std::abs(any(random))});
    }
    return patches;
}

class ClustersOfABox : public testing::Test {
protected:
    std::vector<ClusterPatch> patches = patchesOfABox(333);
    Clusters clusters{patches};
};

TEST_F(ClustersOfABox, HaveEachPatchOnceInOrder) {
    std::vector<std::uint32_t> all = clusters.patches();
    std::sort(all.begin(), all.end());
    ASSERT_EQ(all.size(), patches.size());
    for (std::uint32_t i = 0; i < all.size(); ++i) EXPECT_EQ(all[i], i);
}

TEST_F(ClustersOfABox, FaceOneWay) {
    for (const Clusters::Cluster& cluster : clusters.clusters())
        for (std::uint32_t i = 0; i < cluster.count; ++i)
            EXPECT_EQ(patches[clusters.patches()[cluster.first + i]].normal,
                      patches[clusters.patches()[cluster.first]].normal);
}

TEST_F(ClustersOfABox, LieWithinTheirParents) {
    for (std::uint32_t c = 0; c < clusters.clusters().size(); ++c) {
        const Clusters::Cluster& cluster = clusters.clusters()[c];
        if (cluster.parent == Clusters::kNone) continue;
        ASSERT_LT(cluster.parent, c);
        const Clusters::Cluster& parent = clusters.clusters()[cluster.parent];
        EXPECT_LT(cluster.count, parent.count);
        EXPECT_GE(cluster.first, parent.first);
        EXPECT_LE(cluster.first + cluster.count, parent.first + parent.count);
    }
}

TEST_F(ClustersOfABox, AreCutIntoPartsThatHaveAllOfThem) {
    for (const Clusters::Cluster& cluster : clusters.clusters()) {
        EXPECT_GE(cluster.partCount, 8);
        double quarters = 0;
        std::uint32_t next = cluster.first;
        for (std::size_t k = 0; k < cluster.partCount; ++k) {
            const Clusters::Part& part = cluster.parts[k];
            EXPECT_EQ(part.first, next);
            if (part.quarter == Clusters::kWhole || part.quarter == 3) next += part.count;
            quarters += part.quarter == Clusters::kWhole ? 4 * part.count : 1;
        }
        EXPECT_EQ(quarters, 4.0 * cluster.count);
        EXPECT_EQ(next, cluster.first + cluster.count);
    }
}

TEST(Clusters, KeepAFloorApartFromATableOverIt) {
    std::vector<ClusterPatch> patches;
    for (std::uint32_t i = 0; i < 64; ++i)
        for (const float height : {0.0f, 0.7f})
            patches.push_back({std::uint32_t(patches.size()),
                               {0.25f * float(i % 8), 0.25f * float(i / 8), height},
                               {0, 0, 1},
                               0.06f});
    const Clusters clusters(patches);
    ASSERT_EQ(clusters.clusters()[0].count, 128u);
    for (const std::uint32_t c : clusters.clusters()[0].children)
        for (std::uint32_t i = 0; i < clusters.clusters()[c].count; ++i)
            EXPECT_EQ(patches[clusters.patches()[clusters.clusters()[c].first + i]].centre.z,
                      patches[clusters.patches()[clusters.clusters()[c].first]].centre.z);
}

TEST(Clusters, OfASinglePatchAreNone) {
    const std::vector<ClusterPatch> one{{5, {}, {0, 0, 1}, 1}};
    EXPECT_TRUE(Clusters(one).clusters().empty());
    EXPECT_EQ(Clusters(one).clusterAt(0), Clusters::kNone);
}

} // namespace

} // namespace penumbra
