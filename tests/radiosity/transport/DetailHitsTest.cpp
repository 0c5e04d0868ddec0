// What is seen from where indirect light is in question, while things move.
#include "radiosity/transport/DetailHits.h"
#include "base/Parallel.h"
#include "tests/support/EditedScenes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace penumbra {

namespace {

void settle(DetailHits& hits) {
    while (hits.work(1000)) {
    }
}

/// The first vertex or node of things that are there of which two know different things, or none.
std::string difference(const PatchSet& set, const DetailHits& a, const DetailHits& b) {
    const auto sameHits = [](auto one, auto other) {
        return std::equal(one.begin(), one.end(), other.begin(), other.end());
    };
    for (std::uint32_t n = 0; n < set.nodes.size(); ++n) {
        if (!set.objects[set.nodeBlockObject[n / PatchSet::kBlock].value].present) continue;
        if (a.nodeOpenness(n) != b.nodeOpenness(n) || !sameHits(a.nodeHits(n), b.nodeHits(n)))
            return "node " + std::to_string(n);
    }
    for (std::uint32_t v = 0; v < set.vertices.size(); ++v) {
        const auto *one = a.gatherer(v), *other = b.gatherer(v);
        if (!one && !other) continue;
        const std::uint32_t group = v / DetailHits::kGroup;
        if (!one || !other || one->detail != other->detail || one->shut != other->shut ||
            one->slit != other->slit || one->near != other->near || one->inside != other->inside ||
            !sameHits(a.hits(group, *one), b.hits(group, *other)))
            return "vertex " + std::to_string(v);
    }
    return {};
}

TEST(DetailHits, AfterEditsInStepsAreThoseOfNewOnes) {
    for (std::uint32_t seed = 1; seed <= 12; ++seed) {
        EditableRoom room(seed);
        LitScene lit(placeScene(room.scene()), EditableRoom::meshing(), {.directOnly = true});
        auto hits = std::make_unique<DetailHits>(lit.patches());
        settle(*hits);
        std::mt19937 random(seed);
        std::string said;
        for (int edit = 0; edit < 12; ++edit) {
            said += room.edit();
            const LitScene::Followed followed = lit.follow(placeScene(room.scene()));
            if (followed.rebuilt)
                hits = std::make_unique<DetailHits>(lit.patches());
            else
                hits->apply(followed.change);
            for (std::uint32_t pieces = random() % 20; pieces > 0; --pieces) hits->work(1000);
        }
        settle(*hits);
        const ThreadLimit one(1); // of the new ones: any number gives the same
        DetailHits fresh(lit.patches());
        settle(fresh);
        ASSERT_EQ(difference(lit.patches(), *hits, fresh), "") << "seed " << seed << ": " << said;
    }
}

/// Two closed rooms side by side, each with a box in it.
struct TwoRooms {
    std::shared_ptr<Transform> box;
    Scene scene;
    LitScene lit;
    DetailHits hits;

    TwoRooms()
        : scene(make()),
          lit(placeScene(scene), {.patchSize = 0.4f, .elementSize = 0.1f}, {.directOnly = true}),
          hits(lit.patches()) {
        settle(hits);
    }
    Scene make() {
        const auto boxOf = [] { return boxData({-0.1f, -0.1f, -1}, {0.1f, 0.1f, -0.8f}, false); };
        box = placed("box", moved(0, 0, 0), {std::make_shared<Mesh>("mesh", boxOf())});
        box->setMovable(true);
        return sceneOf(
            {object("room", boxData({-1, -1, -1}, {1, 1, 1}, true)), box,
             placed("other", moved(3, 0, 0),
                    {std::make_shared<Mesh>("walls", boxData({-1, -1, -1}, {1, 1, 1}, true)),
                     std::make_shared<Mesh>("thing", boxOf())})});
    }
    /// \return rays that are traced when the box is moved there
    std::uint64_t raysOfMoveTo(const glm::dmat4& place) {
        const std::uint64_t before = hits.rayCount();
        box->setMatrix(place);
        hits.apply(lit.follow(placeScene(scene)).change);
        settle(hits);
        return hits.rayCount() - before;
    }
};

TEST(DetailHits, AMoveTracesAFewOfAllRays) {
    TwoRooms rooms;
    const std::uint64_t scratch = rooms.hits.rayCount();
    const std::uint64_t moved = rooms.raysOfMoveTo(penumbra::moved(0.2, 0.1, 0));
    EXPECT_GT(moved, 0u);
    EXPECT_LT(moved, scratch / 10);
}

TEST(DetailHits, OfAMoveTheRoomNextDoorIsNotLookedAt) {
    TwoRooms rooms;
    const std::uint64_t before = rooms.hits.groupsVisited();
    rooms.raysOfMoveTo(moved(0.2, 0.1, 0));
    EXPECT_LT(rooms.hits.groupsVisited() - before, before / 2);
}

TEST(DetailHits, ColoursTraceNoRay) {
    TwoRooms rooms;
    const std::uint64_t before = rooms.hits.rayCount();
    SceneChange colours;
    colours.colours = true;
    rooms.hits.apply(colours);
    EXPECT_FALSE(rooms.hits.work(1000));
    EXPECT_EQ(rooms.hits.rayCount(), before);
}

TEST(DetailHits, ABoxEvaluatedAnewChangesNothingWhereNothingWasWrong) {
    TwoRooms rooms;
    DetailHits fresh(rooms.lit.patches());
    settle(fresh);
    const std::uint64_t before = rooms.hits.rayCount();
    rooms.hits.invalidate({glm::vec3(-0.5f), glm::vec3(0.5f)});
    settle(rooms.hits);
    EXPECT_GT(rooms.hits.rayCount(), before);
    EXPECT_EQ(difference(rooms.lit.patches(), rooms.hits, fresh), "");
}

} // namespace

} // namespace penumbra
