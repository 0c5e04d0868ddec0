// What nodes see, while things move.
#include "radiosity/transport/NodeHits.h"
#include "tests/support/FollowedHits.h"
#include "tests/support/RoomsWithDoor.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace penumbra {

namespace {

constexpr MeshingOptions kCoarse{.patchSize = 0.5f, .elementSize = 0.25f};

void settle(NodeHits& hits) {
    while (hits.work(1000)) {
    }
}

/// The first node of things that are there of which two know different things, or none.
std::string difference(const PatchSet& set, const NodeHits& a, const NodeHits& b) {
    for (std::uint32_t n = 0; n < set.nodes.size(); ++n)
        if (a.isThere(set.nodeBlockObject[n / PatchSet::kBlock]) &&
            (a.near(n) != b.near(n) || a.openness(n) != b.openness(n) ||
             !std::ranges::equal(a.hits(n), b.hits(n))))
            return "node " + std::to_string(n);
    return {};
}

/// A door that is shut, and what nodes see as it is opened.
struct Rooms {
    RoomsWithDoor made;
    LitScene lit{placeScene(made.scene), kCoarse, {.directOnly = true}};
    NodeHits hits{lit.patches(), lit.rays()};

    Rooms() {
        settle(hits);
        hits.takeChanged();
    }
    void follow() {
        hits.apply(lit.follow(placeScene(made.scene)).change);
        settle(hits);
    }
};

TEST(NodeHits, AfterEditsInStepsAreThoseOfNewOnes) {
    expectEditsInStepsEndAsNew<NodeHits>([](NodeHits& hits) { return hits.work(1000); },
                                         difference);
}

TEST(NodeHits, RaysFromScratchAreSixtyFourANode) {
    const Rooms rooms;
    const PatchSet& set = rooms.lit.patches();
    const auto padding = std::ranges::count_if(set.nodes, isPadding);
    EXPECT_EQ(rooms.hits.count().rays, 64 * (set.nodes.size() - std::size_t(padding)));
}

TEST(NodeHits, AMoveTracesAFewOfAllRays) {
    Rooms rooms;
    const std::uint64_t scratch = rooms.hits.count().rays;
    rooms.made.box->setMatrix(moved(3.1, 1, 0));
    rooms.follow();
    EXPECT_GT(rooms.hits.count().rays, scratch);
    EXPECT_LT(rooms.hits.count().rays - scratch, scratch / 5);
}

TEST(NodeHits, AreRevisedOnlyIfARayMeetsSomethingElse) {
    Rooms rooms;
    const std::uint64_t before = rooms.hits.revision();
    rooms.hits.invalidate({glm::vec3(0.0f), glm::vec3(2.0f)});
    settle(rooms.hits);
    EXPECT_EQ(rooms.hits.revision(), before);
    EXPECT_TRUE(rooms.hits.takeChanged().empty());
    rooms.made.open();
    rooms.follow();
    EXPECT_GT(rooms.hits.revision(), before);
}

TEST(NodeHits, TellWhichNodesSeeMoreOrLessEachOnce) {
    Rooms rooms;
    const auto openness = rooms.hits.openness();
    const std::vector<double> before(openness.begin(), openness.end());
    rooms.made.box->setMatrix(moved(2.5, 1, 0));
    rooms.follow();
    std::vector<std::uint32_t> changed = rooms.hits.takeChanged(), differ;
    for (std::uint32_t n = 0; n < before.size(); ++n)
        if (rooms.hits.openness(n) != before[n]) differ.push_back(n);
    std::ranges::sort(changed);
    EXPECT_FALSE(differ.empty());
    EXPECT_EQ(changed, differ);
    EXPECT_FALSE(rooms.hits.anyChanged());
}

TEST(NodeHits, TakenOverByAMeshingThatIsTheSameTraceNoRay) {
    RoomsWithDoor made;
    const BuiltPatches one = meshed(made.scene, kCoarse), other = meshed(made.scene, kCoarse);
    const RayScene rays = raysThrough(one.patches);
    NodeHits before(one.patches, rays), now(other.patches, rays);
    settle(before);
    now.takeOver(before, matchPatches(one.patches, other.patches));
    EXPECT_TRUE(now.done());
    EXPECT_EQ(difference(other.patches, now, before), "");
}

TEST(NodeHits, TakenOverFromUnfinishedOnesEndAsNewOnes) {
    RoomsWithDoor made;
    const BuiltPatches one = meshed(made.scene, kCoarse), other = meshed(made.scene, kCoarse);
    const RayScene rays = raysThrough(one.patches);
    NodeHits before(one.patches, rays), now(other.patches, rays), fresh(other.patches, rays);
    before.work(20'000);
    ASSERT_FALSE(before.done());
    now.takeOver(before, matchPatches(one.patches, other.patches));
    settle(now);
    settle(fresh);
    EXPECT_EQ(difference(other.patches, now, fresh), "");
    EXPECT_EQ(now.count().rays + before.count().rays, fresh.count().rays);
}

} // namespace

} // namespace penumbra
