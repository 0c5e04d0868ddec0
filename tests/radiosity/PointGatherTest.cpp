// Light evaluated at a point instead of interpolated.
#include "radiosity/PointGather.h"
#include "radiosity/FormFactor.h"
#include "tests/support/Scenes.h"

#include <gtest/gtest.h>

#include <numbers>

namespace penumbra {

namespace {

const MeshingOptions kMeshing{.patchSize = 0.25f, .elementSize = 0.125f};

TEST(PointGather, HasTheClosedFormOfALampThatNothingHides) {
    const Solution solution(
        sceneOf({object("floor", floorData(-1, 1, -1, 1, 0)), ceilingLamp({0, 0, 2}, 1, 0.5f)}),
        kMeshing);
    const PointGather gather(solution.patches(), solution.rays, solution.lighting);
    const Receiver point{{0.3f, 0.1f, 0.01f}, {0, 0, 1}};
    const float factor =
        polygonFormFactor(point.position, point.normal, solution.patches().emitters[0].polygons[0]);
    EXPECT_FLOAT_EQ(gather.direct(point).r, std::numbers::pi_v<float> * factor);
}

TEST(PointGather, InAFurnaceFindsTheSameLightEverywhere) {
    // rho = 0.5, E = 1: direct light 1 lux, indirect light 1 lux, at any point, turned any way.
    const auto walls = paint(Rgb(0.5f), Rgb(1 / std::numbers::pi_v<float>));
    const Solution solution(
        sceneOf({object("room", boxData({-1, -1, -1}, {1, 1, 1}, true, walls))}), kMeshing,
        {.residual = 1e-6});
    const PointGather gather(solution.patches(), solution.rays, solution.lighting);
    for (const glm::vec3 p :
         {glm::vec3(0.1f, 0.2f, -0.999f), glm::vec3(0.31f, 0.2f, 0.1f),
          glm::vec3(0.9f, -0.97f, -0.999f), glm::vec3(0.99f, -0.99f, -0.999f)}) {
        EXPECT_NEAR(gather.direct({p, {0, 0, 1}}).r, 1, 1e-3);
        EXPECT_NEAR(gather.indirect({p, {0, 0, 1}}).r, 1, 1e-2);
    }
}

TEST(PointGather, BehindABoardIsDark) {
    const Solution solution(
        sceneOf({object("floor", floorData(-1, 1, -1, 1, 0)), ceilingLamp({0, 0, 2}, 1, 0.5f),
                 object("board", floorData(-3, 3, -3, 3, 1, paint(Rgb(0.0f))))}),
        kMeshing);
    const PointGather gather(solution.patches(), solution.rays, solution.lighting);
    EXPECT_EQ(gather.direct({{0.1f, 0.2f, 0.01f}, {0, 0, 1}}), Rgb());
    EXPECT_EQ(gather.indirect({{0.1f, 0.2f, 0.01f}, {0, 0, 1}}), Rgb());
}

} // namespace

} // namespace penumbra
