// What is seen from where indirect light is in question, while things move.
#include "radiosity/transport/DetailHits.h"
#include "tests/support/FollowedHits.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace penumbra {

namespace {

/// The hits of vertices, and of the nodes by which they are judged.
struct AllHits {
    NodeHits nodes;
    DetailHits vertices;

    AllHits(const PatchSet& patches, const RayScene& rays)
        : nodes(patches, rays), vertices(patches, nodes) {}
    void apply(const SceneChange& change) { vertices.apply(change, nodes.apply(change)); }
    bool work() { return nodes.work(1000) || vertices.work(1000); }
    void settle() {
        while (work()) {
        }
    }
    std::uint64_t rays() const { return nodes.count().rays + vertices.count().rays; }
    std::uint64_t groups() const { return nodes.count().groups + vertices.count().groups; }
};

/// The first vertex or node of things that are there of which two know different things, or none.
std::string difference(const PatchSet& set, const AllHits& one, const AllHits& other) {
    const DetailHits &a = one.vertices, &b = other.vertices;
    const auto sameHits = [](auto some, auto others) { return std::ranges::equal(some, others); };
    for (std::uint32_t n = 0; n < set.nodes.size(); ++n) {
        if (!set.objects[set.nodeBlockObject[n / PatchSet::kBlock].value].present) continue;
        if (one.nodes.openness(n) != other.nodes.openness(n) ||
            one.nodes.near(n) != other.nodes.near(n) ||
            !sameHits(one.nodes.hits(n), other.nodes.hits(n)))
            return "node " + std::to_string(n);
    }
    for (std::uint32_t v = 0; v < set.vertices.size(); ++v) {
        const auto *ga = a.gatherer(v), *gb = b.gatherer(v);
        if (!ga && !gb) continue;
        const std::uint32_t group = v / DetailHits::kGroup;
        if (!ga || !gb || ga->detail != gb->detail || ga->shut != gb->shut ||
            ga->slit != gb->slit || ga->near != gb->near || ga->inside != gb->inside ||
            !sameHits(a.hits(group, *ga), b.hits(group, *gb)))
            return "vertex " + std::to_string(v);
    }
    return {};
}

TEST(DetailHits, AfterEditsInStepsAreThoseOfNewOnes) {
    expectEditsInStepsEndAsNew<AllHits>([](AllHits& hits) { return hits.work(); }, difference);
}

/// Two closed rooms side by side, each with a box in it.
struct TwoRooms {
    std::shared_ptr<Transform> box;
    Scene scene;
    LitScene lit;
    AllHits hits;

    TwoRooms()
        : scene(make()),
          lit(placeScene(scene), {.patchSize = 0.4f, .elementSize = 0.1f}, {.directOnly = true}),
          hits(lit.patches(), lit.rays()) {
        hits.settle();
    }
    Scene make() {
        const auto boxOf = [] { return boxData({-0.1f, -0.1f, -1}, {0.1f, 0.1f, -0.8f}, false); };
        box = placed("box", moved(0, 0, 0), {std::make_shared<Mesh>("mesh", boxOf())});
        box->setBeginsObject(true);
        return sceneOf(
            {object("room", boxData({-1, -1, -1}, {1, 1, 1}, true)), box,
             placed("other", moved(3, 0, 0),
                    {std::make_shared<Mesh>("walls", boxData({-1, -1, -1}, {1, 1, 1}, true)),
                     std::make_shared<Mesh>("thing", boxOf())})});
    }
    /// \return rays that are traced when the box is moved there
    std::uint64_t raysOfMoveTo(const glm::dmat4& place) {
        const std::uint64_t before = hits.rays();
        box->setMatrix(place);
        hits.apply(lit.follow(placeScene(scene)).change);
        hits.settle();
        return hits.rays() - before;
    }
};

TEST(DetailHits, AMoveTracesAFewOfAllRays) {
    TwoRooms rooms;
    const std::uint64_t scratch = rooms.hits.rays();
    const std::uint64_t moved = rooms.raysOfMoveTo(penumbra::moved(0.2, 0.1, 0));
    EXPECT_GT(moved, 0u);
    EXPECT_LT(moved, scratch / 10);
}

TEST(DetailHits, OfAMoveTheRoomNextDoorIsNotLookedAt) {
    TwoRooms rooms;
    const std::uint64_t before = rooms.hits.groups();
    rooms.raysOfMoveTo(moved(0.2, 0.1, 0));
    EXPECT_LT(rooms.hits.groups() - before, before / 2);
}

TEST(DetailHits, ColoursTraceNoRay) {
    TwoRooms rooms;
    const std::uint64_t before = rooms.hits.rays();
    SceneChange colours;
    colours.colours = true;
    rooms.hits.apply(colours);
    EXPECT_FALSE(rooms.hits.work());
    EXPECT_EQ(rooms.hits.rays(), before);
}

TEST(DetailHits, ABoxEvaluatedAnewChangesNothingWhereNothingWasWrong) {
    TwoRooms rooms;
    AllHits fresh(rooms.lit.patches(), rooms.lit.rays());
    fresh.settle();
    const std::uint64_t before = rooms.hits.rays();
    const Bounds box{glm::vec3(-0.5f), glm::vec3(0.5f)};
    rooms.hits.nodes.invalidate(box);
    rooms.hits.vertices.invalidate(box);
    rooms.hits.settle();
    EXPECT_GT(rooms.hits.rays(), before);
    EXPECT_EQ(difference(rooms.lit.patches(), rooms.hits, fresh), "");
}

} // namespace

} // namespace penumbra
