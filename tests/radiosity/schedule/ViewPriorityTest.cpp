// What is known of the viewer's sight, kept while it holds.
#include "radiosity/schedule/ViewPriority.h"

#include "radiosity/transport/LitScene.h"
#include "tests/support/Scenes.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <memory>
#include <vector>

namespace penumbra {

namespace {

/// A floor under a light, and two boxes: `near` moves, `far` is a long way from it.
struct Stage {
    Scene scene;
    std::shared_ptr<Transform> near = box("near"), far = box("far");
    Stage() {
        scene.root->add(object("floor", floorData(-4, 4, -4, 4, 0)));
        scene.root->add(ceilingLight({0, 0, 3}, 1, 1, Rgb(100)));
        scene.root->add(near);
        scene.root->add(far);
        near->setMatrix(moved(-3, 0, 0));
        far->setMatrix(moved(3, 0, 0));
    }
    static std::shared_ptr<Transform> box(const char* name) {
        return objectOf(name, {std::make_shared<Mesh>(
                                  "mesh", boxData({-0.3f, -0.3f, 0}, {0.3f, 0.3f, 0.6f}, false))});
    }
};

/// From beside the floor, above it.
Attention from(glm::dvec3 eye) {
    Lens lens;
    lens.focalLength = lens.horizontalAperture = lens.verticalAperture = 1;
    const glm::dmat4 worldToCamera = glm::lookAt(eye, glm::dvec3(0), glm::dvec3(0, 0, 1));
    const Viewpoint viewpoint(makeView(lens, glm::inverse(worldToCamera), 600, 600), 600, 600);
    return {viewpoint, Gaze(viewpoint), 100, {}, {}};
}
constexpr glm::dvec3 kEye{0, -9, 4};

/// What is gained if all vertices become brighter by as much.
std::vector<float> gainsOf(ViewPriority& seen, const PatchSet& set) {
    const std::vector<float> change(PatchSet::kBlock, 1);
    std::vector<float> all, gains(PatchSet::kBlock);
    for (std::uint32_t b = 0; b < set.firstPrivate / PatchSet::kBlock; ++b) {
        seen.gains({0, b, 1, 1}, change, gains);
        all.insert(all.end(), gains.begin(), gains.end());
    }
    return all;
}

struct Watched {
    LitScene lit;
    DirectLight light;
    ViewPriority seen;
    explicit Watched(const Stage& stage)
        : lit(placeScene(stage.scene), {.patchSize = 0.5f, .elementSize = 0.125f},
              {.directOnly = true}),
          light(lit.patches(), lit.rays(), 16),
          seen(lit.patches(), lit.rays(), [this] { return light.vertices(); }) {}
};

TEST(ViewPriority, AsksNothingAgainWhileTheViewerStays) {
    const Stage stage;
    Watched watched(stage);
    watched.seen.attend(from(kEye), 0);
    const std::vector<float> first = gainsOf(watched.seen, watched.lit.patches());
    const std::uint64_t rays = watched.seen.rays();
    EXPECT_GT(rays, 1000u);
    watched.seen.attend(from(kEye), 0);
    EXPECT_EQ(gainsOf(watched.seen, watched.lit.patches()), first);
    EXPECT_EQ(watched.seen.rays(), rays);
    watched.seen.attend(from({-9, 0, 4}), 0);
    EXPECT_NE(gainsOf(watched.seen, watched.lit.patches()), first);
    EXPECT_GT(watched.seen.rays(), rays + 1000);
}

TEST(ViewPriority, AsksAgainOnlyWhatAMoveMayHideOrShow) {
    Stage stage;
    Watched watched(stage);
    watched.seen.attend(from(kEye), 0);
    gainsOf(watched.seen, watched.lit.patches());
    const std::uint64_t all = watched.seen.rays();
    for (const double x : {-2.5, -2.0, -2.8}) {
        stage.near->setMatrix(moved(x, 0.3, 0));
        const LitScene::Followed followed = watched.lit.follow(placeScene(stage.scene));
        ASSERT_FALSE(followed.rebuilt);
        const std::uint64_t before = watched.seen.rays();
        watched.seen.follow(followed.change.objects);
        const std::vector<float> now = gainsOf(watched.seen, watched.lit.patches());
        const std::uint64_t again = watched.seen.rays() - before;
        EXPECT_GT(again, 0u);
        EXPECT_LT(again, all / 2);
        ViewPriority fresh(watched.lit.patches(), watched.lit.rays(),
                           [&] { return watched.light.vertices(); });
        fresh.attend(from(kEye), 0);
        const std::vector<float> anew = gainsOf(fresh, watched.lit.patches());
        for (std::size_t v = 0; v < now.size(); ++v)
            EXPECT_NEAR(now[v], anew[v], 1e-4f * anew[v]) << "vertex " << v << ", at " << x;
    }
}

TEST(ViewPriority, PlacesAndTheirVerticesShareWhatWasFound) {
    const Stage stage;
    Watched watched(stage);
    watched.seen.attend(from(kEye), 0);
    gainsOf(watched.seen, watched.lit.patches());
    const std::uint64_t rays = watched.seen.rays();
    const VertexClusters clusters(watched.lit.patches());
    for (std::uint32_t cluster = 0; cluster < clusters.size(); ++cluster)
        EXPECT_GT(watched.seen.value(cluster).weight, 0) << "cluster " << cluster;
    EXPECT_EQ(watched.seen.rays(), rays);
}

TEST(ViewPriority, APlaceCountsForThePixelsOfItThatAreSeen) {
    const Stage stage;
    Watched watched(stage);
    const PatchSet& set = watched.lit.patches();
    const VertexClusters clusters(set);
    const auto pixelsOfFloor = [&](glm::dvec3 eye) {
        Attention attention = from(eye);
        attention.factors.eccentricity = attention.factors.proximity = false;
        watched.seen.attend(attention, 0);
        double sum = 0;
        for (std::uint32_t b = 0; b < clusters.clusterOf().size(); ++b)
            if (clusters.clusterOf()[b] != ReceiverClusters::kNowhere &&
                set.objects[set.vertexBlockObject[b].value].path == "/floor")
                sum += watched.seen.value(clusters.clusterOf()[b]).weight; // of one block
        return sum;
    };
    constexpr double kPerMetre = 600.0 / 40; // pixels, from so far
    const double above = 8 * 8 * kPerMetre * kPerMetre;
    EXPECT_NEAR(pixelsOfFloor({0.1, 0, 40}), above, 0.1 * above) << "but for what stands on it";
    EXPECT_LT(pixelsOfFloor({0.1, 0, -40}), 0.1 * above);
}

TEST(ViewPriority, AThingTakenAwayShowsOfAPlaceWhatItHid) {
    Stage stage;
    stage.near->setMatrix(moved(3, -1.5, 0)); // in front of the other box
    Watched watched(stage);
    const VertexClusters clusters(watched.lit.patches());
    const auto weights = [&] {
        std::vector<double> all;
        for (std::uint32_t cluster = 0; cluster < clusters.size(); ++cluster)
            all.push_back(watched.seen.value(cluster).weight);
        return all;
    };
    watched.seen.attend(from(kEye), 0);
    const std::vector<double> first = weights();
    const auto to = [&](double x) {
        stage.near->setMatrix(moved(x, -1.5, 0));
        const LitScene::Followed followed = watched.lit.follow(placeScene(stage.scene));
        EXPECT_FALSE(followed.rebuilt);
        watched.seen.follow(followed.change.objects);
        return weights();
    };
    const auto ofFarBox = [&](const std::vector<double>& all) {
        double sum = 0;
        for (std::uint32_t cluster = 0; cluster < clusters.size(); ++cluster)
            if (watched.lit.patches().objects[clusters.objectOf(cluster).value].path == "/far")
                sum += all[cluster];
        return sum;
    };
    const std::vector<double> away = to(-3);
    EXPECT_GT(ofFarBox(away), 1.05 * ofFarBox(first)); // the near one is before its lower part
    const std::vector<double> again = to(3);
    for (std::size_t p = 0; p < first.size(); ++p)
        EXPECT_NEAR(again[p], first[p], 1e-4 * first[p]) << "cluster " << p;
}

TEST(ViewPriority, WhatLiesBesideTheEdgeOfAShadowToTheEyeIsPartlySeen) {
    // The boxes hide some of the floor behind them. What is drawn around a vertex that they hide,
    // but not its neighbour, is seen in part: its priority is higher than that of what is hidden
    // all round.
    const Stage stage;
    Watched watched(stage);
    Attention open = from(kEye);
    open.factors.occlusion = false;
    watched.seen.attend(open, 0);
    const std::vector<float> whole = gainsOf(watched.seen, watched.lit.patches());
    watched.seen.attend(from(kEye), 0);
    const std::vector<float> seen = gainsOf(watched.seen, watched.lit.patches());
    int hidden = 0, partly = 0, clear = 0;
    for (std::size_t v = 0; v < seen.size(); ++v) {
        if (!(whole[v] > 0)) continue;
        const float share = seen[v] / whole[v];
        ++(share < 0.01f ? hidden : share > 0.99f ? clear : partly);
    }
    EXPECT_GT(hidden, 20);
    EXPECT_GT(partly, 10);
    EXPECT_GT(clear, 3 * partly);
}

} // namespace

} // namespace penumbra
