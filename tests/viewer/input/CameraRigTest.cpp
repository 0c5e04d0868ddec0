// The walkthrough's camera.
#include "viewer/input/CameraRig.h"

#include "tests/scenegraph/SceneParts.h"

#include <gtest/gtest.h>

namespace penumbra {

namespace {

class Nowhere : public Surroundings {
public:
    std::optional<Obstacle> ahead(glm::dvec3, glm::dvec3, double) const override {
        return std::nullopt;
    }
};
class Floor : public Surroundings {
public:
    std::optional<Obstacle> ahead(glm::dvec3 from, glm::dvec3 direction, double) const override {
        if (direction.z > -0.99 || from.z < 0) return std::nullopt;
        return Obstacle{from.z, {0, 0, 1}};
    }
};
const Nowhere kNowhere;
const Floor kFloor;

Bookmark at(glm::dvec3 eye, double heading = 0) {
    Bookmark bookmark{"/Eye", {eye, heading, 0}, {}};
    bookmark.lens.clippingRange = {0.01f, 100};
    return bookmark;
}

void letPass(CameraRig& rig, double seconds, const Surroundings& around = kNowhere) {
    for (int i = 0; i < 50; ++i) rig.advance({}, seconds / 50, around);
}

TEST(CameraRig, FliesToABookmarkAndTakesItsLens) {
    CameraRig rig(UpAxis::z, at({0, 0, 0}));
    Bookmark there = at({1, 2, 3}, 0.5);
    there.lens.focalLength = 35;
    rig.flyTo(there);
    EXPECT_TRUE(rig.moving());
    letPass(rig, 0.3);
    EXPECT_NEAR(rig.pose().eye.y, 1, 0.05) << "half way";
    letPass(rig, 0.4);
    EXPECT_EQ(rig.pose(), there.pose);
    EXPECT_EQ(rig.lens().focalLength, 35);
    EXPECT_FALSE(rig.moving());
}

TEST(CameraRig, HandsEndAFlight) {
    CameraRig rig(UpAxis::z, at({0, 0, 0}));
    rig.setMode(CameraMode::fly);
    rig.flyTo(at({0, 10, 0}));
    letPass(rig, 0.3);
    rig.advance({.turn = {0.1, 0}}, 0.01, kNowhere);
    const double reached = rig.pose().eye.y;
    letPass(rig, 2);
    EXPECT_NEAR(rig.pose().eye.y, reached, 0.2);
}

TEST(CameraRig, StaysAtABookmarkInTheAirUntilSomebodyWalks) {
    CameraRig rig(UpAxis::z, at({0, 0, 3}));
    letPass(rig, 2, kFloor);
    rig.advance({.turn = {0.5, 0}}, 0.1, kFloor);
    letPass(rig, 2, kFloor);
    EXPECT_DOUBLE_EQ(rig.pose().eye.z, 3);
    EXPECT_DOUBLE_EQ(rig.pose().heading, 0.5);
    rig.advance({.move = {0, 1, 0}}, 0.1, kFloor);
    letPass(rig, 2, kFloor);
    EXPECT_NEAR(rig.pose().eye.z, rig.options.eyeHeight, 1e-6);
}

TEST(CameraRig, FramesABoxWholly) {
    CameraRig rig(UpAxis::z, at({0, -1, 0}));
    const Bounds box{{-2, 4, -1}, {1, 6, 2}};
    rig.frame(box);
    letPass(rig, 1);
    const View view = rig.view(1600, 900);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 p(corner & 1 ? box.lower.x : box.upper.x,
                           corner & 2 ? box.lower.y : box.upper.y,
                           corner & 4 ? box.lower.z : box.upper.z);
        const glm::dvec4 clip = view.worldToClip() * glm::dvec4(p, 1);
        EXPECT_LE(std::max(std::abs(clip.x), std::abs(clip.y)), clip.w);
    }
}

TEST(CameraRig, OrbitModeCirclesByKeysAndWheel) {
    CameraRig rig(UpAxis::z, at({0, -2, 0}));
    rig.setMode(CameraMode::orbit);
    rig.setOrbitCentre({0, 0, 0});
    for (int i = 0; i < 20; ++i) rig.advance({.move = {1, 0, 0}}, 0.05, kNowhere);
    EXPECT_NEAR(glm::length(rig.pose().eye), 2, 1e-9);
    EXPECT_GT(std::abs(rig.pose().eye.x), 1);
    rig.advance({.dolly = 1}, 0.05, kNowhere);
    EXPECT_TRUE(rig.moving());
    letPass(rig, 3);
    EXPECT_FALSE(rig.moving());
    EXPECT_LT(glm::length(rig.pose().eye), 1.9);
}

TEST(CameraRig, OpensAtTheFirstCameraOrShowsTheWholeScene) {
    Scene scene;
    scene.upAxis = UpAxis::z;
    scene.root->add(square("floor"));
    const Bookmark whole = openingView(placeScene(scene), UpAxis::z);
    EXPECT_TRUE(whole.path.empty());
    EXPECT_GT(whole.pose.eye.z, 0.5);
    EXPECT_LT(whole.pose.pitch, 0);
    const auto metres = glm::scale(glm::dmat4(1.0), glm::dvec3(0.01));
    Lens lens;
    lens.clippingRange = {10, 10000};
    scene.root->add(placed("units", metres, {std::make_shared<Camera>("Eye", lens)}));
    const Bookmark first = openingView(placeScene(scene), UpAxis::z);
    EXPECT_EQ(first.path, "/units/Eye");
    EXPECT_FLOAT_EQ(first.lens.clippingRange.x, 0.1f) << "in metres";
}

} // namespace

} // namespace penumbra
