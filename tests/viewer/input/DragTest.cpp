// Things that follow the pointer.
#include "viewer/input/Drag.h"

#include "tests/scenegraph/SceneParts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace penumbra {

namespace {

const Compass kCompass(UpAxis::z);
const SupportPlane kFloor{Support::floor, {0, 0, 1}};

SightLine through(glm::dvec3 from, glm::dvec3 to) {
    return {from, glm::normalize(to - from)};
}
const glm::dvec3 kEye(0, -4, 2);

void expectNear(glm::dvec3 a, glm::dvec3 b, double tolerance = 1e-9) {
    EXPECT_LT(glm::distance(a, b), tolerance) << a.x << ' ' << a.y << ' ' << a.z;
}

TEST(Drag, ThePointThatWasTakenHoldOfStaysUnderThePointer) {
    const glm::dvec3 hold(0.2, 0, 0.5);
    const glm::dmat4 start = glm::translate(glm::dmat4(1.0), {0, 0, 0.1});
    Drag drag(hold, start, kFloor, kCompass);
    drag.moved(through(kEye, hold), Drag::Mode::slide, 0);
    for (const glm::dvec3 to : {glm::dvec3(1, 1, 0.5), glm::dvec3(-2, 3, 0.5), hold}) {
        const glm::dmat4 now = drag.moved(through(kEye, to), Drag::Mode::slide, 0);
        expectNear(glm::dvec3(now[3]) - glm::dvec3(start[3]), to - hold);
        EXPECT_EQ(glm::dmat3(now), glm::dmat3(start)) << "its axes keep every bit";
    }
}

TEST(Drag, LiftsUpAndDownAndSlidesOnFromThereWithoutAJump) {
    const glm::dvec3 hold(0, 0, 0.5);
    Drag drag(hold, glm::dmat4(1.0), kFloor, kCompass);
    drag.moved(through(kEye, hold), Drag::Mode::slide, 0);
    drag.moved(through(kEye, hold), Drag::Mode::lift, 0);
    const glm::dmat4 lifted = drag.moved(through(kEye, {0.7, 0, 1.5}), Drag::Mode::lift, 0);
    expectNear(glm::dvec3(lifted[3]), {0, 0, 1});
    const glm::dmat4 same = drag.moved(through(kEye, {0.7, 0, 1.5}), Drag::Mode::slide, 0);
    EXPECT_EQ(same, lifted);
    const glm::dmat4 slid = drag.moved(through(kEye, {1.2, 0, 1.5}), Drag::Mode::slide, 0);
    EXPECT_NEAR(slid[3].z, 1, 1e-9);
    EXPECT_GT(slid[3].x, 0.3);
}

TEST(Drag, TurnsAboutTheUprightLineThroughTheHand) {
    const glm::dvec3 hold(1, 0, 0.5);
    Drag drag(hold, glm::dmat4(1.0), kFloor, kCompass);
    drag.moved(through(kEye, hold), Drag::Mode::turn, 0);
    const glm::dmat4 now = drag.moved(through(kEye, {2, 0, 0}), Drag::Mode::turn, 0.25);
    expectNear(glm::dvec3(now * glm::dvec4(hold, 1)), hold);
    expectNear(glm::dvec3(now[0]), {0, 1, 0}); // a quarter of the picture: a quarter turn
}

TEST(Drag, AboveTheHorizonAndEdgeOnNothingFliesAway) {
    const glm::dvec3 hold(0, 0, 0.5);
    Drag drag(hold, glm::dmat4(1.0), kFloor, kCompass);
    drag.moved(through(kEye, hold), Drag::Mode::slide, 0);
    const glm::dmat4 before = drag.toWorld();
    EXPECT_EQ(drag.moved({kEye, glm::normalize(glm::dvec3(0, 1, 0.5))}, Drag::Mode::slide, 0),
              before);
    const glm::dvec3 low(0, -4, 0.5); // the plane is seen edge-on: sideways only
    Drag flat(hold, glm::dmat4(1.0), kFloor, kCompass);
    flat.moved(through(low, hold), Drag::Mode::slide, 0);
    const glm::dmat4 moved = flat.moved(through(low, {0.5, 0, 0.9}), Drag::Mode::slide, 0);
    expectNear(glm::dvec3(moved[3]), {0.5, 0, 0});
}

/// A room of 4 m with a box of 1 m in it.
SupportPlane supportAt(glm::dvec3 place) {
    Scene scene;
    scene.upAxis = UpAxis::z;
    scene.root->add(polygon("floor", {{-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}}));
    scene.root->add(polygon("ceiling", {{-2, -2, 4}, {2, -2, 4}, {2, 2, 4}, {-2, 2, 4}}));
    scene.root->add(polygon("wall", {{-2, 2, 0}, {2, 2, 0}, {2, 2, 4}, {-2, 2, 4}}));
    const auto box = objectOf(
        "box",
        {polygon("lid", {{-.5f, -.5f, .5f}, {.5f, -.5f, .5f}, {.5f, .5f, .5f}, {-.5f, .5f, .5f}}),
         polygon("base",
                 {{-.5f, -.5f, -.5f}, {.5f, -.5f, -.5f}, {.5f, .5f, -.5f}, {-.5f, .5f, -.5f}})});
    box->setMatrix(glm::translate(glm::dmat4(1.0), place));
    scene.root->add(box);
    const PlacedScene placed = placeScene(scene);
    return supportOf(SceneRays(placed), ObjectId{std::uint32_t(placed.objects.size() - 1)},
                     kCompass);
}

TEST(Drag, FollowsWhatTheThingRestsOn) {
    EXPECT_EQ(supportAt({0, 0, 0.51}).support, Support::floor);
    EXPECT_EQ(supportAt({0, 0, 3.48}).support, Support::ceiling);
    const SupportPlane wall = supportAt({0, 1.49, 2});
    EXPECT_EQ(wall.support, Support::wall);
    EXPECT_EQ(wall.normal, glm::dvec3(0, -1, 0));
    EXPECT_EQ(supportAt({0, 1.49, 0.5}).support, Support::floor) << "it stands by the wall";
    const SupportPlane air = supportAt({0, 0, 2});
    EXPECT_EQ(air.support, Support::none);
    EXPECT_EQ(air.normal, kCompass.up);
}

} // namespace

} // namespace penumbra
