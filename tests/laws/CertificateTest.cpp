// What is drawn is as sure as what patches send: the vertices of a solution that stopped early lie
// as near to those of one that went on as the two certificates say.
#include "io/usd/scene/UsdScene.h"
#include "tests/support/Scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

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

TEST(Certificate, IsNotHeldUpByWhatIsTinyAndBright) {
    // Specks of 2 mm, a centimetre below a light: they send next to nothing, but owe more by the
    // square metre than anything else. By power alone they were left to the end.
    const auto certificate = [](int specks) {
        const Scene scene =
            sceneOf({object("room", boxData({-1, -1, -1}, {1, 1, 1}, true, paint(Rgb(0.7f)))),
                     ceilingLight({0, 0, 0.9f}, 0.4f, 0.4f)});
        for (int i = 0; i < specks; ++i) {
            const int row = i / 8;
            const glm::vec3 at(0.02f * float(i % 8), 0.02f * float(row), 0.89f);
            scene.root->add(object("speck" + std::to_string(i),
                                   boxData(at - 0.001f, at + 0.001f, false, paint(Rgb(0.7f)))));
        }
        const Solution solution(scene, {.patchSize = 0.4f, .elementSize = 0.1f},
                                {.mostShots = 1500});
        return solution.solver.statistics().certificate;
    };
    EXPECT_LT(certificate(48), 10 * certificate(0)); // by power: 340 times
}

} // namespace

} // namespace penumbra
