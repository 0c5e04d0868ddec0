// Light that a region concerns is evaluated anew on request.
#include "tests/support/EditedScenes.h"
#include "tests/support/LitDifference.h"

#include <gtest/gtest.h>

#include <limits>

namespace penumbra {

namespace {

const SolverOptions kTight{.residual = 1e-5};

std::uint64_t raysOf(const WorkCount& work) {
    return work.rays.total();
}

class Invalidate : public testing::Test {
protected:
    EditableRoom room{7};
    LitScene lit{placeScene(room.scene()), EditableRoom::meshing(), kTight};
    SolveStatistics scratch;

    Invalidate() {
        lit.solver().settle();
        scratch = lit.solver().statistics();
    }

    /// What it costs to evaluate a box anew.
    SolveStatistics invalidated(const Bounds& box) {
        const SolveStatistics before = lit.solver().statistics();
        lit.invalidate(box);
        lit.solver().settle();
        SolveStatistics cost = lit.solver().statistics();
        cost.direct = cost.direct - before.direct;
        cost.indirect = cost.indirect - before.indirect;
        cost.shots -= before.shots;
        return cost;
    }
};

TEST_F(Invalidate, OfASmallBoxChangesNoBitAndCostsLessThanFromScratch) {
    const Lighting before = lit.solver().lighting();
    const std::vector<glm::dvec3> nodes = lit.solver().nodeIlluminance();
    const SolveStatistics cost = invalidated({{0.2f, 0.2f, 0}, {0.3f, 0.3f, 0.1f}});
    EXPECT_EQ(lit.solver().lighting().direct, before.direct);
    EXPECT_EQ(lit.solver().lighting().indirect, before.indirect);
    EXPECT_EQ(lit.solver().nodeIlluminance(), nodes);
    EXPECT_EQ(cost.shots, 0u);
    EXPECT_GT(raysOf(cost.direct), 0u);
    EXPECT_GT(raysOf(cost.indirect), 0u);
    EXPECT_LT(raysOf(cost.direct), raysOf(scratch.direct));
    EXPECT_LT(raysOf(cost.indirect), raysOf(scratch.indirect));
}

/// What is known of what is owed after the shots, of which each concerned a part of the room alone,
/// is what is found when all of it is worked out again.
TEST_F(Invalidate, OfNothingAtAllLeavesTheCertificateAsItIs) {
    const glm::vec3 far(1000);
    const SolveStatistics cost = invalidated({far, far + 1.0f});
    EXPECT_EQ(cost.shots, 0u);
    EXPECT_GT(scratch.certificate, 0);
    EXPECT_EQ(cost.certificate, scratch.certificate);
    EXPECT_EQ(cost.residual, scratch.residual);
    EXPECT_EQ(cost.meanRadiosity, scratch.meanRadiosity);
}

TEST_F(Invalidate, OfEverythingTracesAllDirectLightAgainAndChangesNoBit) {
    const Lighting before = lit.solver().lighting();
    const glm::vec3 far(std::numeric_limits<float>::infinity());
    const SolveStatistics cost = invalidated({-far, far});
    EXPECT_EQ(raysOf(cost.direct), raysOf(scratch.direct));
    EXPECT_EQ(lit.solver().lighting().direct, before.direct);
    EXPECT_EQ(lit.solver().lighting().indirect, before.indirect);
}

TEST_F(Invalidate, OfAnEmptyBoxOrOneOutsideCostsNoRayOfAnyRow) {
    const SolveStatistics empty = invalidated({});
    EXPECT_EQ(raysOf(empty.direct) + raysOf(empty.indirect), 0u);
    const auto raysOfNodes = [&] { return lit.solver().nodeHits()->count().rays; };
    const std::uint64_t before = raysOfNodes();
    const SolveStatistics outside = invalidated({{9, 9, 9}, {10, 10, 10}});
    EXPECT_EQ(raysOf(outside.direct), 0u);
    // What meets nothing may cross the box: rays from the outsides of things.
    EXPECT_EQ(raysOf(outside.indirect), raysOfNodes() - before);
}

TEST_F(Invalidate, CountsBesideEditsThatNobodyHasTakenInYet) {
    for (int i = 0; i < 5; ++i) {
        room.edit();
        lit.follow(placeScene(room.scene()));
        lit.invalidate({{1, 1, 0.5f}, {1.2f, 1.2f, 0.7f}});
        lit.solver().step(0.001);
    }
    lit.solver().settle();
    LitScene other(placeScene(room.scene()), sizesOf(lit.patches()), kTight);
    other.solver().settle();
    EXPECT_EQ(difference(lit, other), "");
}

/// Two solvers over one room with a table: one was led to believe that the table is not there.
TEST(InvalidatedRegion, HealsRowsThatAreWrongInIt) {
    const Scene scene = sceneOf({object("room", boxData({0, 0, 0}, {3, 3, 2}, true)),
                                 object("table", boxData({1, 1, 0.6f}, {1.8f, 1.6f, 0.7f}, false)),
                                 ceilingLight({1.5f, 1.5f, 1.99f}, 0.5f, 0.5f, Rgb(100))});
    const BuiltPatches built = meshed(scene, {.patchSize = 0.5f, .elementSize = 0.25f});
    const PatchSet& set = built.patches;
    ObjectId table;
    for (std::uint32_t o = 0; o < set.objects.size(); ++o)
        if (set.objects[o].path == "/table") table = {o};
    ASSERT_TRUE(table.valid());
    RayScene rays(set.rayMeshes, set.skin);

    rays.show(table, false);
    rays.commit();
    Solver healed(set, rays, kTight);
    healed.settle();
    rays.show(table, true);
    rays.commit();
    Solver right(set, rays, kTight);
    right.settle();
    ASSERT_NE(healed.lighting().direct, right.lighting().direct);

    healed.invalidate(boundsOf(set, table));
    healed.settle();
    EXPECT_EQ(healed.lighting().direct, right.lighting().direct);
    const double allowed = healed.statistics().certificate + right.statistics().certificate + 1e-4;
    const std::vector<Rgb> a = healed.radiosity(), b = right.radiosity();
    for (std::size_t p = 0; p < a.size(); ++p)
        EXPECT_LE(maxChannel(absolute(a[p] - b[p])), allowed) << p;
}

} // namespace

} // namespace penumbra
