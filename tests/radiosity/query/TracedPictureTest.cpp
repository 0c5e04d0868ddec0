// The traced picture, as people see it.
#include "radiosity/query/TracedPicture.h"

#include "tests/support/Scenes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace penumbra {

namespace {

/// Looks up, from below the ceiling, at a light of 10,000 nit in front of nothing.
struct SeenLight {
    static Scene make() {
        Scene scene;
        scene.root->add(ceilingLight({0, 0, 2}, 1, 1, Rgb(10000)));
        scene.root->add(object("floor", floorData(-2, 2, -2, 2, 0)));
        return scene;
    }
    Solution solution{make(), {.patchSize = 1, .elementSize = 0.5f}, {.directOnly = true}};

    FrameLayers trace(const FinalOptions& options) const {
        Lens lens;
        lens.focalLength = 1;
        lens.horizontalAperture = 2;
        glm::dmat4 camera(1.0); // looks along +z
        camera[1] = {0, -1, 0, 0}, camera[2] = {0, 0, -1, 0}, camera[3] = {0.013, 0.02, 1, 1};
        const View view = makeView(lens, camera, 48, 48);
        return traceFrame(solution.patches(), solution.rays, solution.lighting, view, 48, 48,
                          options);
    }
};

Rgb cutOff(Rgb colour) {
    return {std::min(colour.r, 1.0f), std::min(colour.g, 1.0f), std::min(colour.b, 1.0f)};
}

TEST(TracedPicture, EdgesOfBrightEmittersAreAveragedAfterTheToneCurve) {
    const SeenLight light;
    const FrameLayers frame = light.trace({.tone = cutOff});
    int between = 0;
    for (std::size_t i = 0; i < frame.pixelCount(); ++i) {
        EXPECT_NEAR(frame.shown[i].g, frame.alpha[i], 1e-5f);
        between += frame.shown[i].g > 0.2f && frame.shown[i].g < 0.8f;
    }
    EXPECT_GT(between, 24) << "along four edges";
}

TEST(TracedPicture, AskingForWhatIsShownChangesNoOtherLayer) {
    const SeenLight light;
    const FrameLayers plain = light.trace({}), toned = light.trace({.tone = cutOff});
    EXPECT_TRUE(plain.shown.empty());
    EXPECT_EQ(plain.beauty, toned.beauty);
    EXPECT_EQ(plain.direct, toned.direct);
    EXPECT_EQ(plain.alpha, toned.alpha);
}

} // namespace

} // namespace penumbra
