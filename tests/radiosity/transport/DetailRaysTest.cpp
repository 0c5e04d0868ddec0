// Rays over the hemisphere, and which of them an edit concerns.
#include "radiosity/transport/DetailRays.h"
#include "tests/support/Scenes.h"

#include <gtest/gtest.h>

#include <bit>

namespace penumbra {

namespace {

/// A room and a box in it that moves from x = -0.5 to x = 0.5.
struct Moving {
    std::shared_ptr<Transform> box =
        placed("box", moved(-0.5, 0, 0),
               {std::make_shared<Mesh>("mesh",
                                       boxData({-0.1f, -0.1f, -0.1f}, {0.1f, 0.1f, 0.1f}, false))});
    Scene scene = sceneOf({object("room", boxData({-1, -1, -1}, {1, 1, 1}, true)), box});
    LitScene lit;
    DetailRays rays;

    Moving()
        : lit((box->setBeginsObject(true), placeScene(scene)),
              {.patchSize = 0.5f, .elementSize = 0.25f}, {.directOnly = true}),
          rays(lit.patches(), lit.rays(), 0.3f) {}

    DetailRays::Moved move() {
        box->setMatrix(moved(0.5, 0, 0));
        const SceneChange change = lit.follow(placeScene(scene)).change;
        const ObjectId id = change.objects.front();
        return {{lit.patches().objects[id.value].elements}, {boundsOf(lit.patches(), id)}};
    }
};

TEST(DetailRays, ThoseThatMeetSomethingElseAfterAMoveAreAmongTheAffectedAndTheseAreFew) {
    Moving scene;
    const PatchSet& set = scene.lit.patches();
    std::vector<DetailRays::Hits> before(set.nodes.size());
    for (std::size_t n = 0; n < set.nodes.size(); ++n) {
        if (isPadding(set.nodes[n])) continue;
        EXPECT_EQ(scene.rays.follow(set.nodes[n], DetailRays::kAllRays, true, before[n]), 64);
    }
    const DetailRays::Moved moved = scene.move();
    int affected = 0, changed = 0, all = 0;
    const Range walls = set.objects[0].nodes;
    for (std::size_t n = walls.first; n < walls.end(); ++n) {
        const Receiver& node = set.nodes[n];
        if (isPadding(node)) continue;
        const std::uint64_t bits =
            scene.rays.affected(node, DetailRays::kAllRays, before[n].elements, moved, 1e30f);
        DetailRays::Hits now;
        scene.rays.follow(node, DetailRays::kAllRays, true, now);
        for (std::size_t r = 0; r < DetailRays::kRays; ++r) {
            const bool differs = now.elements[r] != before[n].elements[r] ||
                                 (now.near >> r & 1) != (before[n].near >> r & 1);
            EXPECT_TRUE(!differs || (bits >> r & 1));
            changed += differs;
        }
        affected += std::popcount(bits);
        all += DetailRays::kRays;
    }
    EXPECT_GT(changed, 0);
    EXPECT_LT(affected, 3 * changed); // some cross the box beside the thing, or see it as before
    EXPECT_LT(affected, all / 10);
}

TEST(DetailRays, WhatIsFartherThanMattersAffectsNothing) {
    Moving scene;
    const Receiver far{{-0.9f, 0, -0.99f}, {0, 0, 1}};
    const std::array<std::uint32_t, DetailRays::kRays> free = [] {
        std::array<std::uint32_t, DetailRays::kRays> hits;
        hits.fill(Element::kNone);
        return hits;
    }();
    const DetailRays::Moved moved{{}, {Bounds{{-0.2f, -0.2f, -0.2f}, {0.2f, 0.2f, 0.2f}}}};
    EXPECT_EQ(scene.rays.affected(far, DetailRays::kAllRays, free, moved, 0.3f), 0u);
    EXPECT_NE(scene.rays.affected(far, DetailRays::kAllRays, free, moved, 3), 0u);
    const DetailRays::Moved below{{}, {Bounds{{-1, -1, -2}, {1, 1, -1}}}};
    EXPECT_EQ(scene.rays.affected(far, DetailRays::kAllRays, free, below, 3), 0u);
}

TEST(DetailRays, TellsWhatIsNearAndBoundsTheWays) {
    Moving scene;
    const Receiver floor{{0.3f, 0.2f, -0.999f}, {0, 0, 1}};
    DetailRays::Hits hits;
    scene.rays.follow(floor, DetailRays::kAllRays, true, hits);
    EXPECT_EQ(hits.near, 0u); // 0.3 m
    const Bounds room{glm::vec3(-1.001f), glm::vec3(1.001f)};
    EXPECT_TRUE(hits.ways.contains(floor.position));
    EXPECT_TRUE(room.contains(hits.ways.lower) && room.contains(hits.ways.upper));
    EXPECT_FALSE(inSlit(hits.elements));
}

} // namespace

} // namespace penumbra
