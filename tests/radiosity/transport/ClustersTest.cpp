// Patches are put together with their like, each once.
#include "radiosity/transport/Clusters.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
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
    Clusters clusters{patches, 1};
};

TEST_F(ClustersOfABox, HaveEachPatchOnceInOrder) {
    std::vector<std::uint32_t> all = clusters.patches();
    std::sort(all.begin(), all.end());
    ASSERT_EQ(all.size(), patches.size());
    for (std::uint32_t i = 0; i < all.size(); ++i) EXPECT_EQ(all[i], i);
}

TEST_F(ClustersOfABox, HaveAllOfItsSides) {
    EXPECT_EQ(clusters.clusters()[0].count, patches.size());
    EXPECT_EQ(clusters.clusters()[0].parent, Clusters::kNone);
}

TEST_F(ClustersOfABox, FaceOneWayIfItsPatchesAreLarge) {
    const Clusters large(patches, 0.01f);
    for (const Clusters::Cluster& cluster : large.clusters())
        for (std::uint32_t i = 0; i < cluster.count; ++i)
            EXPECT_EQ(patches[large.patches()[cluster.first + i]].normal,
                      patches[large.patches()[cluster.first]].normal);
}

TEST_F(ClustersOfABox, HavePartsThatFaceOneWay) {
    for (const Clusters::Cluster& cluster : clusters.clusters())
        for (const Clusters::Part& part : cluster.parts)
            for (std::uint32_t i = part.first; i < part.first + part.count; ++i)
                EXPECT_EQ(patches[clusters.members()[i]].normal,
                          patches[clusters.members()[part.first]].normal);
}

TEST_F(ClustersOfABox, SendWhatFacesAwayFromEachOtherInQuartersOfTheirOwn) {
    for (const Clusters::Cluster& cluster : clusters.clusters())
        for (std::size_t a = 0; a < Clusters::kParts; ++a)
            for (std::size_t b = 4 * (a / 4); b < a; ++b) {
                const Clusters::Part &one = cluster.parts[a], &other = cluster.parts[b];
                if (one.count == 0 || other.count == 0) continue;
                EXPECT_GE(glm::dot(patches[clusters.members()[one.first]].normal,
                                   patches[clusters.members()[other.first]].normal),
                          0);
            }
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
        std::uint32_t begin = ~0u, parts = 0;
        std::map<std::uint32_t, unsigned> quarters; // of each member, as bits
        for (const Clusters::Part& part : cluster.parts) {
            if (part.count == 0) continue;
            ++parts;
            begin = std::min(begin, part.first);
            const bool whole = part.quarter == Clusters::kWhole;
            EXPECT_TRUE(whole || part.count == 1);
            const unsigned own = whole ? 15u : 1u << part.quarter;
            for (std::uint32_t i = part.first; i < part.first + part.count; ++i) {
                EXPECT_EQ(quarters[i] & own, 0u);
                quarters[i] |= own;
            }
        }
        EXPECT_GE(parts, 8u);
        EXPECT_EQ(quarters.size(), cluster.count);
        EXPECT_EQ(quarters.rbegin()->first, begin + cluster.count - 1);
        for (const auto& [member, bits] : quarters) EXPECT_EQ(bits, 15u);
        std::vector<std::uint32_t> own, all;
        for (std::uint32_t i = 0; i < cluster.count; ++i) {
            own.push_back(clusters.members()[begin + i]);
            all.push_back(clusters.patches()[cluster.first + i]);
        }
        std::ranges::sort(own), std::ranges::sort(all);
        EXPECT_EQ(own, all);
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
    const Clusters clusters(patches, 0.01f);
    ASSERT_EQ(clusters.clusters()[0].count, 128u);
    for (const std::uint32_t c : clusters.clusters()[0].children)
        for (std::uint32_t i = 0; i < clusters.clusters()[c].count; ++i)
            EXPECT_EQ(patches[clusters.patches()[clusters.clusters()[c].first + i]].centre.z,
                      patches[clusters.patches()[clusters.clusters()[c].first]].centre.z);
}

TEST(Clusters, OfASinglePatchAreNone) {
    const std::vector<ClusterPatch> one{{5, {}, {0, 0, 1}, 1}};
    EXPECT_TRUE(Clusters(one, 0.01f).clusters().empty());
    EXPECT_EQ(Clusters(one, 0.01f).clusterAt(0), Clusters::kNone);
}

} // namespace

} // namespace penumbra
