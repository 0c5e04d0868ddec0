// What is drawn is as sure as what patches send: the vertices of a solution that stopped early lie
// as near to those of one that went on as the two certificates say.
#include "io/usd/scene/UsdScene.h"
#include "tests/support/Scenes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace penumbra {

namespace {

TEST(Certificate, CoversWhatIsDrawn) {
    const Scene scene = *loadUsdScene(PENUMBRA_SOURCE_DIR "/scenes/cornell.usda").scene;
    for (float patchSize : {0.3f, 0.25f, 0.2f, 0.16f}) {
        const MeshingOptions meshing{.patchSize = patchSize, .elementSize = patchSize / 8};
        const Solution exact(scene, meshing, {.residual = 1e-7});
        for (double residual : {1e-3, 1e-4, 1e-5, 1e-6}) {
            const Solution early(scene, meshing, {.residual = residual});
            const double allowed =
                early.solver.statistics().certificate + exact.solver.statistics().certificate;
            double most = 0;
            for (std::size_t v = 0; v < early.lighting.indirect.size(); ++v)
                most = std::max<double>(most, maxChannel(absolute(early.lighting.indirect[v] -
                                                                  exact.lighting.indirect[v])));
            EXPECT_LE(most, allowed) << "patches of " << patchSize << " m, residual " << residual;
        }
    }
}

} // namespace

} // namespace penumbra
