// Indirect light that varies faster than patches can tell.
#include "radiosity/transport/DetailGather.h"
#include "base/Parallel.h"
#include "radiosity/query/LitSurface.h"
#include "tests/support/Scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

namespace penumbra {

namespace {

const MeshingOptions kMeshing{.patchSize = 0.4f, .elementSize = 0.1f};

NodePtr room(float rho) {
    return object("room", boxData({-1, -1, -1}, {1, 1, 1}, true, paint(Rgb(rho))));
}

/// Mean indirect light of the vertices of the wall x = -1 that lie within `radius` of its middle
/// [lux].
double onWall(const Solution& solution, const Lighting& lighting, glm::vec3 middle, float radius) {
    double sum = 0;
    int count = 0;
    for (std::size_t v = 0; v < lighting.indirect.size(); ++v) {
        const Vertex& vertex = solution.patches().vertices[v];
        if (vertex.position.x != -1 || glm::distance(vertex.position, middle) > radius) continue;
        sum += lighting.indirect[v].r;
        ++count;
    }
    return sum / count;
}

TEST(DetailGather, DarkensTheGapBehindABoard) {
    // A board of 1 x 1 m hangs 3 cm in front of a wall: on the wall behind its middle little is
    // left, on the wall beside it nothing changes.
    MeshData board = polygonData({{-0.97f, -0.5f, -0.5f},
                                  {-0.97f, 0.5f, -0.5f},
                                  {-0.97f, 0.5f, 0.5f},
                                  {-0.97f, -0.5f, 0.5f}});
    board.doubleSided = true;
    const Solution solution(
        sceneOf({room(0.5f), object("board", board), ceilingLight({0, 0, 0.99f}, 0.8f, 0.8f)}),
        kMeshing);
    const double gap = onWall(solution, solution.lighting, {-1, 0, 0}, 0.25f);
    const double free = onWall(solution, solution.lighting, {-1, 0.8f, 0}, 0.1f);
    EXPECT_GT(free, 0.02);
    EXPECT_LT(gap, 0.1 * free);
}

TEST(DetailGather, LightDiesInASlitMuchNarrowerThanAnElement) {
    // 5 mm behind a board of 1 x 1 m: what the slit's rim receives must not be drawn a whole
    // element deep, let alone spread from there.
    const MeshData board = boxData({-0.995f, -0.5f, -0.5f}, {-0.975f, 0.5f, 0.5f}, false);
    const Solution solution(
        sceneOf({room(0.7f), object("board", board), ceilingLight({0, 0, 0.99f}, 0.8f, 0.8f)}),
        kMeshing);
    const double free = onWall(solution, solution.lighting, {-1, 0, 0.8f}, 0.1f);
    EXPECT_GT(free, 0.02);
    EXPECT_LT(onWall(solution, solution.lighting, {-1, 0, 0.35f}, 0.08f), 0.03 * free);
    EXPECT_LT(onWall(solution, solution.lighting, {-1, 0, 0}, 0.25f), 0.002 * free);
}

TEST(DetailGather, InASlitOfAFurnaceNoLightIsLostOrMade) {
    // rho = 0.5 and E = 1 on all sides: indirect light 1 lux also between two surfaces 2 cm apart.
    const auto walls = paint(Rgb(0.5f), Rgb(1 / std::numbers::pi_v<float>));
    const Solution solution(sceneOf({object("room", boxData({-1, -1, -1}, {1, 1, 1}, true, walls)),
                                     object("board", boxData({-0.98f, -0.5f, -0.5f},
                                                             {-0.9f, 0.5f, 0.5f}, false, walls))}),
                            kMeshing, {.residual = 1e-5});
    EXPECT_NEAR(onWall(solution, solution.lighting, {-1, 0, 0}, 0.25f), 1, 0.02);
    EXPECT_NEAR(onWall(solution, solution.lighting, {-1, 0, 0.4f}, 0.15f), 1, 0.04);
}

TEST(DetailGather, LeavesAnEvenlyLitRoomAsItIs) {
    const Scene scene = sceneOf({room(0.5f), ceilingLight({0, 0, 0.99f}, 0.8f, 0.8f)});
    const Solution solution(scene, kMeshing);
    const Lighting raw = Solution(scene, kMeshing, {.detail = false}).lighting;
    EXPECT_NEAR(onWall(solution, solution.lighting, {-1, 0, 0}, 0.5f),
                onWall(solution, raw, {-1, 0, 0}, 0.5f), 0.01);
    for (std::size_t v = 0; v < raw.direct.size(); ++v)
        EXPECT_EQ(raw.direct[v], solution.lighting.direct[v]);
}

TEST(DetailGather, AFarBrightSpotLeavesNoBlotchBesideABox) {
    // A light close above the floor makes a small bright spot there. A black box under the ceiling
    // can only take light from the ceiling around it, whichever single rays meet the spot.
    const NodePtr light = ceilingLight({0.5f, 0.3f, -0.95f}, 0.05f, 0.05f);
    const MeshData box = boxData({-0.3f, -0.3f, 0.9f}, {0.3f, 0.3f, 1}, false, paint(Rgb(0)));
    const Solution with(sceneOf({room(0.5f), light, object("box", box)}), kMeshing);
    const Solution without(sceneOf({room(0.5f), light}), kMeshing, {.detail = false});
    const LitSurface lit(with.patches(), with.lighting), free(without.patches(), without.lighting);
    float most = 0;
    for (float x = -0.85f; x < 0.9f; x += 0.05f)
        for (float y = -0.85f; y < 0.9f; y += 0.05f) {
            if (std::max(std::abs(x), std::abs(y)) < 0.35f) continue;
            const auto here = lit.under({x, y, 1}, {0, 0, -1});
            const auto alone = free.under({x, y, 1}, {0, 0, -1});
            ASSERT_TRUE(here && alone);
            most = std::max(most, here->indirect.r / alone->indirect.r);
        }
    EXPECT_LT(most, 1.1f);
}

TEST(DetailGather, BlocksThatAreAskedForAreThoseOfTheWhole) {
    const Solution solution(sceneOf({room(0.5f), ceilingLight({0, 0, 0.99f}, 0.8f, 0.8f),
                                     object("box", boxData({-0.5f, -0.5f, -1}, {0, 0, 0}, false))}),
                            kMeshing);
    Lighting some;
    const std::vector<std::uint32_t> blocks{0, 3};
    solution.solver.light(blocks, some);
    ASSERT_EQ(some.direct.size(), solution.lighting.direct.size());
    for (std::uint32_t v = 0; v < some.direct.size(); ++v) {
        const std::uint32_t block = v / PatchSet::kBlock;
        const bool asked = std::count(blocks.begin(), blocks.end(), block) > 0;
        EXPECT_EQ(some.direct[v], asked ? solution.lighting.direct[v] : Rgb());
        EXPECT_EQ(some.indirect[v], asked ? solution.lighting.indirect[v] : Rgb());
    }
}

TEST(DetailGather, SweptInStepsAndByAnyNumberOfThreadsTheLightIsTheSame) {
    const Scene scene =
        sceneOf({room(0.5f), ceilingLight({0, 0, 0.99f}, 0.8f, 0.8f),
                 object("board", boxData({-0.995f, -0.5f, -0.5f}, {-0.975f, 0.5f, 0.5f}, false))});
    const Solution whole(scene, kMeshing);
    LitScene crumbs(placeScene(scene), kMeshing, {});
    {
        const ThreadLimit one(1);
        while (!crumbs.solver().step(1e-9)) {
        }
    }
    EXPECT_EQ(crumbs.solver().lighting().indirect, whole.lighting.indirect);
}

} // namespace

} // namespace penumbra
