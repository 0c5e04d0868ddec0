// What a view shows of the drawn surface, found once, lit again and again.
#include "radiosity/query/DrawnView.h"

#include "importance/SeenItems.h"
#include "radiosity/query/LitSurface.h"
#include "tests/support/Scenes.h"

#include <gtest/gtest.h>

#include <numbers>

namespace penumbra {

namespace {

/// A floor under a light, seen from above and from the side, with sky above its far edge.
struct SeenFloor {
    static Scene make() {
        Scene scene;
        scene.root->add(object("floor", floorData(-2, 2, -2, 2, 0, paint(Rgb(0.5f, 0.4f, 0.2f)))));
        scene.root->add(ceilingLight({0, 0, 2}, 1, 1, Rgb(100)));
        return scene;
    }
    Solution solution{make(), {.patchSize = 0.5f, .elementSize = 0.25f}, {.directOnly = true}};
    View view;

    SeenFloor() {
        Lens lens;
        lens.focalLength = 1;
        lens.horizontalAperture = 2;
        glm::dmat4 camera(1.0); // looks along +y, its up is z
        camera[1] = {0, 0, 1, 0}, camera[2] = {0, -1, 0, 0}, camera[3] = {0, -3, 1, 1};
        view = makeView(lens, camera, 40, 30);
    }
};

TEST(DrawnView, ShowsWhatRaysFindOnTheDrawnSurface) {
    const SeenFloor floor;
    const DrawnView drawn(floor.solution.patches(), floor.view, 40, 30);
    const std::vector<Rgb> colours = drawn.colours(floor.solution.lighting);
    // Pixel (20, 24): its middle is at (0.025, -0.6333) of the picture's half width and height.
    const glm::vec3 origin(floor.view.eye), direction(0.025f, 1, -0.475f);
    const auto hit =
        LitSurface(floor.solution.patches(), floor.solution.lighting).trace(origin, direction);
    ASSERT_TRUE(hit);
    ASSERT_GT(hit->direct.r, 1);
    const Rgb expected =
        std::numbers::inv_pi_v<float> * (Rgb(0.5f, 0.4f, 0.2f) * (hit->direct + hit->indirect));
    EXPECT_NEAR(colours[24 * 40 + 20].r, expected.r, 1e-4f * expected.r);
    EXPECT_NEAR(colours[24 * 40 + 20].b, expected.b, 1e-4f * expected.b);
    EXPECT_EQ(colours[0], Rgb()); // sky
    EXPECT_NEAR(drawn.luminances(floor.solution.lighting).at(20, 24), luminance(expected),
                1e-4f * luminance(expected));
}

TEST(DrawnView, IsMeteredAlikeWhateverTheSizeOfThePicture) {
    // Half of the view is sky, which does not count.
    const SeenFloor floor;
    const auto mean = [](const std::vector<float>& values) {
        double sum = 0;
        for (const float value : values) sum += double(value) / double(values.size());
        return sum;
    };
    const Lighting& light = floor.solution.lighting;
    const std::vector<float> fine = meterView(floor.solution.patches(), floor.view, light);
    const std::vector<float> coarse =
        DrawnView(floor.solution.patches(), floor.view, 97, 61).metered(light);
    EXPECT_GT(fine.size(), MeterGrid::kColumns * MeterGrid::kRows / 5u);
    EXPECT_LT(fine.size(), MeterGrid::kColumns * MeterGrid::kRows / 2u);
    EXPECT_NEAR(double(coarse.size()) / double(fine.size()), 1, 0.05);
    EXPECT_NEAR(mean(coarse) / mean(fine), 1, 0.02);
}

TEST(DrawnView, FollowsTheLightWithoutRays) {
    const SeenFloor floor;
    const DrawnView drawn(floor.solution.patches(), floor.view, 40, 30);
    Lighting twice = floor.solution.lighting;
    for (Rgb& lux : twice.direct) lux *= 2;
    EXPECT_FLOAT_EQ(drawn.luminances(twice).at(20, 24),
                    2 * drawn.luminances(floor.solution.lighting).at(20, 24));
}

TEST(DrawnView, KnowsWhichBlockIsInFront) {
    const SeenFloor floor;
    const PatchSet& patches = floor.solution.patches();
    const DrawnView drawn(patches, floor.view, 40, 30);
    const std::vector<std::uint32_t> blocks = drawn.blocks();
    EXPECT_EQ(blocks[0], kNoItem);
    const std::uint32_t seen = blocks[24 * 40 + 20];
    ASSERT_LT(seen, patches.vertexBlockObject.size());
    EXPECT_EQ(patches.objects[patches.vertexBlockObject[seen].value].path, "/floor");
}

} // namespace

} // namespace penumbra
