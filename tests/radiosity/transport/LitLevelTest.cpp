// How large the certificate is beside the light that there is.
#include "radiosity/transport/LitLevel.h"

#include "tests/support/Scenes.h"

#include <gtest/gtest.h>

namespace penumbra {

namespace {

const MeshingOptions kCoarse{.patchSize = 0.5f, .elementSize = 0.25f};

/// A room with a light of this radiance [nit] at its ceiling; a black plate may hang 2 cm below.
Scene room(float nits, bool shaded) {
    const auto grey = paint(Rgb(0.5f)), black = paint(Rgb(0.01f));
    const auto walls = object("room", boxData({-1, -1, -1}, {1, 1, 1}, true, grey));
    const auto light = ceilingLight({0, 0, 0.99f}, 0.8f, 0.6f, {nits, nits, nits});
    if (!shaded) return sceneOf({walls, light});
    const MeshData plate = boxData({-0.6f, -0.5f, 0.96f}, {0.6f, 0.5f, 0.97f}, false, black);
    return sceneOf({walls, light, object("shade", plate)});
}

double shareOf(const Scene& scene, double residual) {
    const SolveStatistics s = Solution(scene, kCoarse, {.residual = residual}).solver.statistics();
    EXPECT_LE(s.certificate, residual * s.brightest);
    return certificateOfLit(s.certificate, s.litIlluminance);
}

TEST(LitLevel, IsTheMedianByAreaOfWhatIsLit) {
    LitLevel level;
    level.add(1000, 1); // beside the emitter
    level.add(0, 50);   // no light gets there
    level.add(2, 5);
    level.add(3, 4);
    EXPECT_EQ(level.median(), 2);
    level.add(3, 1);
    EXPECT_EQ(level.median(), 3);
}

TEST(LitLevel, OfNothingLitIsZeroAndNothingIsDividedByIt) {
    LitLevel level;
    EXPECT_EQ(level.median(), 0);
    level.add(0, 1);
    EXPECT_EQ(level.median(), 0);
    EXPECT_EQ(certificateOfLit(0, level.median()), 0);
    EXPECT_EQ(certificateOfLit(7, level.median()), 0);
}

TEST(LitLevel, HasAShareThatDoesNotDependOnHowBrightTheEmittersAre) {
    const double share = shareOf(room(10, false), 1e-2);
    EXPECT_GT(share, 0);
    EXPECT_LT(share, 1);
    // By powers of two: rounding, which decides between patches that owe alike, is the same.
    for (float times : {0x1p-10f, 4.0f, 0x1p13f})
        EXPECT_NEAR(shareOf(room(10 * times, false), 1e-2), share, 1e-3 * share) << times;
}

TEST(LitLevel, BehindAShadeTheSameShareOfTheEmitterIsMoreThanTheLight) {
    // Both are relaxed to within the same share of the emitter's exitance.
    EXPECT_LT(shareOf(room(10, false), 5e-3), 1);
    EXPECT_GT(shareOf(room(10, true), 5e-3), 1);
}

TEST(LitLevel, OfARoomIsNotThatOfTheGroundAroundIt) {
    const auto statistics = [](const Scene& scene) {
        return Solution(scene, kCoarse, {}).solver.statistics();
    };
    const NodePtr ground = object("ground", floorData(-110, 110, -110, 110, -1.5f));
    const NodePtr light = ceilingLight({60, 60, 4}, 1, 1); // of the ground alone
    const Scene within = room(100, false);
    Scene around = room(100, false);
    around.root->add(ground);
    around.root->add(light);
    const SolveStatistics alone = statistics(within), both = statistics(around);
    // The room has an outside now, where there is little light.
    EXPECT_GT(both.litIlluminance, 0.1 * alone.litIlluminance);
    EXPECT_GT(both.meanRadiosity, 0.4 * alone.meanRadiosity);

    const SolveStatistics nothingElse = statistics(sceneOf({ground, light}));
    EXPECT_GT(nothingElse.litIlluminance, 0);
    EXPECT_GT(nothingElse.meanRadiosity, 0);
}

} // namespace

} // namespace penumbra
