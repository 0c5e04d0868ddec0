// Light evaluated at a point instead of interpolated.
#include "radiosity/query/PointGather.h"
#include "radiosity/rows/FormFactor.h"
#include "tests/support/Scenes.h"

#include <gtest/gtest.h>

#include <numbers>

namespace penumbra {

namespace {

const MeshingOptions kMeshing{.patchSize = 0.25f, .elementSize = 0.125f};

TEST(PointGather, HasTheClosedFormOfALightThatNothingHides) {
    const Solution solution(
        sceneOf({object("floor", floorData(-1, 1, -1, 1, 0)), ceilingLight({0, 0, 2}, 1, 0.5f)}),
        kMeshing);
    const PointGather gather(solution.patches(), solution.rays, solution.lighting);
    const Receiver point{{0.3f, 0.1f, 0.01f}, {0, 0, 1}};
    const float factor =
        polygonFormFactor(point.position, point.normal, solution.patches().emitters[0].polygons[0]);
    EXPECT_FLOAT_EQ(gather.direct(point).r, std::numbers::pi_v<float> * factor);
}

TEST(PointGather, ALightThatIsHiddenGivesNoLight) {
    const auto light =
        objectOf("lamp", {std::make_shared<Light>("light", SphereShape{0.1f}, Rgb(100))});
    light->setMatrix(moved(0, 0, 2));
    const auto choice = std::make_shared<Switch>("choice");
    choice->add(light);
    const Receiver point{{0.3f, 0.1f, 0.01f}, {0, 0, 1}};
    for (const bool visible : {true, false}) {
        choice->setVisible(visible);
        const Solution solution(sceneOf({object("floor", floorData(-1, 1, -1, 1, 0)), choice}),
                                kMeshing);
        ASSERT_EQ(solution.patches().emitters.size(), 1u);
        const PointGather gather(solution.patches(), solution.rays, solution.lighting);
        EXPECT_EQ(gather.direct(point).g > 0, visible);
    }
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
        sceneOf({object("floor", floorData(-1, 1, -1, 1, 0)), ceilingLight({0, 0, 2}, 1, 0.5f),
                 object("board", floorData(-3, 3, -3, 3, 1, paint(Rgb(0.0f))))}),
        kMeshing);
    const PointGather gather(solution.patches(), solution.rays, solution.lighting);
    EXPECT_EQ(gather.direct({{0.1f, 0.2f, 0.01f}, {0, 0, 1}}), Rgb());
    EXPECT_EQ(gather.indirect({{0.1f, 0.2f, 0.01f}, {0, 0, 1}}), Rgb());
}

/// A white board of 1 x 1 m, 2 cm thick, that hovers over the floor of a white room with a light.
Scene boardOverFloor(float gap, std::shared_ptr<Material> white) {
    return sceneOf(
        {object("room", boxData({-1, -1, 0}, {1, 1, 1}, true, white)),
         object("board", boxData({-0.5f, -0.5f, gap}, {0.5f, 0.5f, gap + 0.02f}, false, white)),
         ceilingLight({0, 0, 0.99f}, 1, 1)});
}

TEST(PointGather, LightDiesInASlitMuchNarrowerThanAnElement) {
    // 5 mm high: from the rim inwards each 5 cm leave less of the light, at 20 cm nothing that
    // counts is left. Elements of 12.5 cm know nothing of that.
    const Solution solution(boardOverFloor(0.005f, paint(Rgb(0.7f))), kMeshing);
    const PointGather gather(solution.patches(), solution.rays, solution.lighting);
    const auto light = [&](float x) {
        const Receiver point{{x, 0.03f, 1e-4f}, {0, 0, 1}};
        return luminance(gather.direct(point) + gather.indirect(point));
    };
    const float outside = light(0.75f), deep = light(0.45f), deeper = light(0.3f);
    EXPECT_GT(outside, 0.1f);
    EXPECT_LT(deep, 0.02f * outside);
    EXPECT_LT(deeper, 0.3f * deep);
    EXPECT_LT(deeper, 0.001f * outside);
}

TEST(PointGather, InASlitOfAFurnaceNoLightIsLostOrMade) {
    // rho = 0.5 and E = 1 on all sides: 2 lux also between two surfaces 1 cm apart.
    const Solution solution(
        boardOverFloor(0.01f, paint(Rgb(0.5f), Rgb(1 / std::numbers::pi_v<float>))), kMeshing,
        {.residual = 1e-5});
    const PointGather gather(solution.patches(), solution.rays, solution.lighting);
    for (const float x : {0.1f, 0.4f, 0.49f}) {
        const Receiver point{{x, 0.03f, 1e-4f}, {0, 0, 1}};
        EXPECT_NEAR((gather.direct(point) + gather.indirect(point)).r, 2, 0.04) << x;
    }
}

} // namespace

} // namespace penumbra
