// An estimate of what a solution takes, against the solution.
#include "radiosity/query/CostEstimate.h"

#include "radiosity/query/MemoryWarning.h"
#include "tests/support/Scenes.h"

#include <gtest/gtest.h>

namespace penumbra {

namespace {

const MeshingOptions kSizes{.patchSize = 0.2f, .elementSize = 0.05f};

Scene furnished() {
    return sceneOf({object("room", boxData({-1, -1, -1}, {1, 1, 1}, true)),
                    object("box", boxData({-0.5f, -0.3f, -1}, {0.1f, 0.4f, -0.2f}, false)),
                    object("board", floorData(0.3f, 0.9f, -0.5f, 0.5f, 0.1f)),
                    ceilingLight({0, 0, 0.99f}, 0.8f, 0.6f, {10, 9, 8}),
                    ceilingLight({0.5f, 0.5f, 0.2f}, 0.1f, 0.1f, {90, 90, 90})});
}

/// A scene that is meshed and not lit.
struct Unlit {
    Scene scene;
    PlacedScene placed = placeScene(scene);
    LitScene lit{placed, kSizes, {.directOnly = true}};

    explicit Unlit(Scene from) : scene(std::move(from)) {}
    CostEstimate cost(const SolverOptions& options = {}) const {
        return estimateCost(lit, options);
    }
};

void expectWithinAFactorOfTwo(double estimate, double truth) {
    EXPECT_GT(estimate, 0.5 * truth);
    EXPECT_LT(estimate, 2 * truth);
}

TEST(CostEstimate, KnowsTheRaysAndBytesOfASolutionWithinAFactorOfTwo) {
    const CostEstimate cost = Unlit(furnished()).cost();
    const Solution solution(furnished(), kSizes);
    const SolveStatistics s = solution.solver.statistics();
    expectWithinAFactorOfTwo(cost.directRays, double(s.direct.rays.total()));
    expectWithinAFactorOfTwo(cost.indirectRays, double(s.indirect.rays.total()));
    expectWithinAFactorOfTwo(cost.detailRays, double(s.detail.rays.total()));
    expectWithinAFactorOfTwo(cost.rowBytes, 1.5 * double(solution.solver.indirect().rowBytes()));
    EXPECT_GT(cost.allSeconds, cost.directSeconds);
    EXPECT_EQ(cost.rowsKept, 1);
}

TEST(CostEstimate, OfDirectLightAloneKnowsNothingElse) {
    const CostEstimate cost = Unlit(furnished()).cost({.directOnly = true});
    EXPECT_GT(cost.directRays, 0);
    EXPECT_EQ(cost.indirectRays + cost.detailRays + cost.rowBytes, 0);
}

TEST(CostEstimate, TracesNothingThatTheSolverCounts) {
    const Unlit unlit(furnished());
    unlit.cost();
    EXPECT_EQ(unlit.lit.solver().done().rays, 0u);
}

TEST(CostEstimate, RisesWhereRowsHaveNoRoom) {
    const CostEstimate cost = Unlit(furnished()).cost({.memory = 1});
    EXPECT_EQ(cost.rowsKept, 0);
    EXPECT_GT(cost.indirectRays, 2 * Unlit(furnished()).cost().indirectRays);
}

TEST(CostEstimate, OfADarkSceneIsNothingButItsMesh) {
    const CostEstimate cost =
        Unlit(sceneOf({object("room", boxData({-1, -1, -1}, {1, 1, 1}, true))})).cost();
    EXPECT_EQ(cost.directRays + cost.indirectRays + cost.detailRays, 0);
    EXPECT_GT(cost.allBytes, 0);
}

TEST(MemoryWarning, SaysWhatAllRowsWouldTake) {
    const Solution kept(furnished(), kSizes), dropped(furnished(), kSizes, {.memory = 1});
    EXPECT_EQ(memoryWarning(kept.solver, kept.patches()), "");
    EXPECT_NE(memoryWarning(dropped.solver, dropped.patches()).find("no rows of patches are kept"),
              std::string::npos);
    EXPECT_EQ(kept.solver.statistics().rowsNotKept, 0u);
    EXPECT_GT(dropped.solver.statistics().rowsNotKept, 0u);
}

} // namespace

} // namespace penumbra
