// The blocks of vertices, as clusters that a viewer may see.
#include "radiosity/schedule/VertexClusters.h"

#include "tests/support/Scenes.h"

#include <gtest/gtest.h>

#include <numbers>

namespace penumbra {

namespace {

/// A floor of 4 x 4 m with a light over it, and a box that can be moved.
struct Floor {
    Scene scene;
    std::shared_ptr<Transform> box = objectOf(
        "box",
        {std::make_shared<Mesh>("mesh", boxData({-0.5f, -0.5f, 0}, {0.5f, 0.5f, 1}, false))});
    std::shared_ptr<Material> cloth = paint(Rgb(0.5f));
    Floor() {
        scene.root->add(object("floor", floorData(-2, 2, -2, 2, 0, cloth)));
        scene.root->add(ceilingLight({0, 0, 3}, 1, 1, Rgb(100)));
        box->setMatrix(moved(9, 0, 0));
        scene.root->add(box);
    }
};
constexpr MeshingOptions kMeshing{.patchSize = 0.5f, .elementSize = 0.125f};
constexpr SolverOptions kDirect{.directOnly = true};

/// All clusters of an object.
std::vector<std::uint32_t> clustersOf(const VertexClusters& clusters, const PatchSet& patches,
                                      const std::string& path) {
    std::vector<std::uint32_t> result;
    for (std::uint32_t b = 0; b < clusters.clusterOf().size(); ++b) {
        const std::uint32_t cluster = clusters.clusterOf()[b];
        if (patches.objects[patches.vertexBlockObject[b].value].path == path &&
            (result.empty() || result.back() != cluster))
            result.push_back(cluster);
    }
    return result;
}

TEST(VertexClusters, CoverTheSurfaceOnce) {
    const Solution solution(Floor().scene, kMeshing, kDirect);
    const VertexClusters clusters(solution.patches(), 8);
    double area = 0;
    Bounds box;
    const auto ofFloor = clustersOf(clusters, solution.patches(), "/floor");
    for (std::uint32_t cluster : ofFloor) {
        const ReceiverCluster known = clusters.at(cluster, solution.lighting.direct);
        std::size_t blocks = 0;
        for (std::uint32_t other : clusters.clusterOf()) blocks += other == cluster;
        area += double(known.area) * double(blocks); // of an average block
        box.add(known.box);
        EXPECT_NEAR(known.normal.z, 1, 1e-5);
        EXPECT_NEAR(known.reflectance, 0.5, 1e-5);
    }
    EXPECT_NEAR(area, 16, 0.01);
    EXPECT_NEAR(box.size().x, 4, 0.1);
}

TEST(VertexClusters, ShowTheLightThatIsThere) {
    const Solution solution(Floor().scene, kMeshing, kDirect);
    const VertexClusters clusters(solution.patches(), 2000);
    for (std::uint32_t cluster : clustersOf(clusters, solution.patches(), "/floor")) {
        const ReceiverCluster known = clusters.at(cluster, solution.lighting.direct);
        double sum = 0, count = 0; // over all of its vertices
        for (std::uint32_t b = 0; b < clusters.clusterOf().size(); ++b)
            for (std::uint32_t v = b * PatchSet::kBlock; v < (b + 1) * PatchSet::kBlock; ++v)
                if (clusters.clusterOf()[b] == cluster &&
                    !isPadding(solution.patches().vertices[v].receiver))
                    sum += luminance(solution.lighting.direct[v]), count += 1;
        const double expected = 0.5 * sum / count / std::numbers::pi;
        EXPECT_NEAR(known.luminance, expected, 0.3 * expected);
    }
}

TEST(VertexClusters, FollowWhatIsMoved) {
    Floor floor;
    LitScene lit(placeScene(floor.scene), kMeshing, kDirect);
    VertexClusters clusters(lit.patches());
    const auto ofBox = clustersOf(clusters, lit.patches(), "/box");
    ASSERT_FALSE(ofBox.empty());
    const std::vector<Rgb> dark(lit.patches().vertices.size());
    const float before = clusters.at(ofBox[0], dark).box.centre().x;
    floor.box->setMatrix(moved(5, 0, 0));
    const auto followed = lit.follow(placeScene(floor.scene));
    ASSERT_FALSE(followed.rebuilt);
    clusters.follow(followed.change.objects);
    EXPECT_NEAR(clusters.at(ofBox[0], dark).box.centre().x, before - 4, 1e-4);
}

TEST(VertexClusters, ReflectAsTheyWereRepaintedAndAreAsLarge) {
    Floor floor;
    LitScene lit(placeScene(floor.scene), kMeshing, kDirect);
    VertexClusters clusters(lit.patches());
    const std::uint32_t cluster = clustersOf(clusters, lit.patches(), "/floor")[0];
    const float area = clusters.known(cluster).area;
    floor.cloth->setReflectance(Rgb(0.2f));
    const auto followed = lit.follow(placeScene(floor.scene));
    ASSERT_TRUE(followed.change.colours);
    clusters.measure();
    EXPECT_NEAR(clusters.known(cluster).reflectance, 0.2, 1e-5);
    EXPECT_EQ(clusters.known(cluster).area, area);
}

TEST(VertexClusters, AreSpokenForByVerticesSpreadOverThem) {
    const Solution solution(Floor().scene, kMeshing, kDirect);
    const VertexClusters clusters(solution.patches(), 1);
    const std::uint32_t cluster = clustersOf(clusters, solution.patches(), "/floor")[0];
    Bounds box;
    const std::vector<std::size_t> vertices = clusters.spread(cluster);
    for (const std::size_t v : vertices) {
        EXPECT_EQ(clusters.clusterOf()[v / PatchSet::kBlock], cluster);
        EXPECT_FALSE(isPadding(solution.patches().vertices[v].receiver));
        box.add(solution.patches().vertices[v].receiver.position);
    }
    EXPECT_GE(vertices.size(), 6u);
    EXPECT_LE(vertices.size(), 10u);
    EXPECT_GT(box.size().x, 2); // of 4 m
    EXPECT_GT(box.size().y, 2);
}

} // namespace

} // namespace penumbra
