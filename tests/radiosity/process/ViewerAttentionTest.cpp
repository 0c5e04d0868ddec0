// What a worker passes on to its solver of the viewer.
#include "radiosity/process/ViewerAttention.h"

#include "tests/support/Scenes.h"

#include <gtest/gtest.h>

namespace penumbra {

namespace {

View viewFrom(glm::dvec3 eye, int width, int height) {
    glm::dmat4 camera(1.0);
    camera[3] = glm::dvec4(eye, 1);
    return makeView({}, camera, width, height);
}

TEST(AttentionFor, SeesThePictureInTheShapeOfTheView) {
    const Attention wide = attentionFor(viewFrom({1, 2, 3}, 1920, 1080), {});
    EXPECT_NEAR(wide.viewpoint.pixels(), 1280 * 720, 1000);
    ASSERT_TRUE(wide.viewpoint.eye());
    EXPECT_EQ(*wide.viewpoint.eye(), glm::dvec3(1, 2, 3));
    EXPECT_NEAR(attentionFor(viewFrom({}, 100, 100), {}).viewpoint.pixels(), 720 * 720, 1000);
}

TEST(AttentionFor, LooksAtWhatIsMovedAsWell) {
    const View view = viewFrom({0, 0, 0}, 100, 100); // along -z
    const Bounds atSide{{1.9f, -0.1f, -2.1f}, {2.1f, 0.1f, -1.9f}};
    const glm::dvec3 side = glm::normalize(glm::dvec3(1, 0, -1));
    EXPECT_NEAR(attentionFor(view, {}).gaze.eccentricity(side), 45, 0.1);
    EXPECT_NEAR(attentionFor(view, atSide).gaze.eccentricity(side), 0, 0.1);
    EXPECT_NEAR(attentionFor(view, atSide).gaze.eccentricity({0, 0, -1}), 0, 0.1);
}

TEST(ViewerAttention, SwitchesTheOrderAndBackWhileLightIsWorkedOn) {
    Scene scene;
    scene.root->add(object("room", boxData({-2, -2, 0}, {2, 2, 2.5f}, true)));
    scene.root->add(ceilingLight({0, 0, 2.4f}, 0.6f, 0.6f, Rgb(300)));
    const MeshingOptions meshing{.patchSize = 0.5f, .elementSize = 0.25f};
    LitScene plain(placeScene(scene), meshing, {.residual = 1e-4, .policy = PolicyKind::plain});
    plain.solver().settle();
    LitScene lit(placeScene(scene), meshing, {.residual = 1e-4});
    ViewerAttention viewer;
    viewer.setCamera(viewFrom({0, 0, 1}, 100, 100));
    double now = 100;
    // Each switch sorts all work anew, which steps this small do in several: so not at each of
    // them.
    for (int turn = 0; !lit.solver().step(1e-4); ++turn) {
        viewer.setPolicy(PolicyKind(turn / 8 % 3));
        viewer.setCamera(viewFrom({0, 0.01 * turn, 1}, 100, 100));
        viewer.update(lit.solver(), now += 0.02);
    }
    EXPECT_EQ(lit.solver().lighting().direct, plain.solver().lighting().direct);
}

} // namespace

} // namespace penumbra
