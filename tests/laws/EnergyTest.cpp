// Light is neither made nor lost on its way: what emitters send arrives, and no more than that.
#include "tests/support/Scenes.h"

#include <gtest/gtest.h>

#include <numbers>

namespace penumbra {

namespace {

/// Flux that the elements of a solution receive straight from the emitters [lm], channel r.
double directFlux(const Solution& solution) {
    double flux = 0;
    for (const Element& element : solution.patches().elements) {
        const std::size_t count = element.isTriangle() ? 3 : 4;
        double mean = 0;
        for (std::size_t k = 0; k < count; ++k)
            mean += solution.lighting.direct[element.vertices[k]].r / double(count);
        flux += mean * elementArea(solution.patches(), element);
    }
    return flux;
}

/// A closed box of 2 x 2 x 2 m that absorbs everything.
NodePtr blackRoom() {
    return object("room", boxData({-1, -1, -1}, {1, 1, 1}, true, paint(Rgb(0.0f))));
}

const MeshingOptions kMeshing{.patchSize = 0.25f, .elementSize = 0.0625f};
const SolverOptions kDirect{.directOnly = true};

TEST(Energy, OfARectangularLightArrivesInABlackRoom) {
    // E A = pi L A for L = 1 nit and 0.6 x 0.4 m.
    Solution solution(sceneOf({blackRoom(), ceilingLight({0.1f, 0, 0.5f}, 0.6f, 0.4f)}), kMeshing,
                      kDirect);
    EXPECT_NEAR(directFlux(solution) / (std::numbers::pi * 0.24), 1, 0.01);
}

TEST(Energy, OfADiskLightArrivesInABlackRoom) {
    const auto light = std::make_shared<Light>("light", DiskShape{0.3f}, Rgb(1.0f));
    Solution solution(sceneOf({blackRoom(), placed("lamp", moved(0.1, 0, 0.5), {light})}), kMeshing,
                      kDirect);
    EXPECT_NEAR(directFlux(solution) / (std::numbers::pi * std::numbers::pi * 0.09), 1, 0.01);
}

TEST(Energy, OfASphericalLightArrivesInABlackRoom) {
    const auto light = std::make_shared<Light>("light", SphereShape{0.2f}, Rgb(1.0f));
    Solution solution(sceneOf({blackRoom(), placed("lamp", moved(0.1, -0.2, 0.3), {light})}),
                      kMeshing, kDirect);
    EXPECT_NEAR(directFlux(solution) / (std::numbers::pi * 4 * std::numbers::pi * 0.04), 1, 0.01);
}

TEST(Energy, IsSharedBetweenARoomAndWhatStandsInIt) {
    // A black block shades the floor, but what the floor loses the block receives.
    const auto block = boxData({-0.5f, -0.4f, -1}, {0.3f, 0.4f, -0.3f}, false, paint(Rgb(0.0f)));
    Solution solution(
        sceneOf({blackRoom(), object("block", block), ceilingLight({0.1f, 0, 0.5f}, 0.6f, 0.4f)}),
        kMeshing, kDirect);
    EXPECT_NEAR(directFlux(solution) / (std::numbers::pi * 0.24), 1, 0.01);
}

TEST(Energy, AbsorbedInAGreyRoomIsWhatTheLightSends) {
    // In a closed room the flux absorbed, sum of (1 - rho) H A, is the light's flux: the balance
    // that holds for direct and indirect light together. The light's own black back absorbs
    // nothing: it has none, and its front is met.
    Solution solution(
        sceneOf({object("room", boxData({-1, -1, -1}, {1, 1, 1}, true, paint(Rgb(0.5f)))),
                 ceilingLight({0, 0, 0.999f}, 0.6f, 0.4f)}),
        kMeshing, {.residual = 1e-5});
    double absorbed = 0;
    for (const Element& element : solution.patches().elements)
        absorbed += (1 - solution.patches().materials[element.material].reflectance.r) *
                    elementMean(element, solution.lighting).r *
                    elementArea(solution.patches(), element);
    EXPECT_NEAR(absorbed / (std::numbers::pi * 0.24), 1, 0.01);
}

TEST(Energy, ReflectedByNothingIsNothing) {
    Solution solution(sceneOf({blackRoom(), ceilingLight({0, 0, 0.5f}, 0.6f, 0.4f)}), kMeshing);
    for (Rgb indirect : solution.lighting.indirect) EXPECT_EQ(indirect, Rgb());
    EXPECT_EQ(solution.solver.statistics().shots, 0u);
    EXPECT_EQ(solution.solver.statistics().certificate, 0);
}

} // namespace

} // namespace penumbra
