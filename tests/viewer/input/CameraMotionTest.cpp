// Walking, flying and orbiting as functions of input and time.
#include "viewer/input/CameraMotion.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <vector>

namespace penumbra {

namespace {

const Compass kCompass(UpAxis::z);

/// Planes that face the walker.
class Planes : public Surroundings {
public:
    struct Plane {
        glm::dvec3 point, normal;
    };
    explicit Planes(std::vector<Plane> planes = {}) : planes_(std::move(planes)) {}
    std::optional<Obstacle> ahead(glm::dvec3 from, glm::dvec3 direction,
                                  double reach) const override {
        std::optional<Obstacle> nearest;
        for (const auto& [point, normal] : planes_) {
            const double towards = -glm::dot(direction, normal);
            const double distance = glm::dot(from - point, normal) / towards;
            if (towards <= 0 || distance < 0 || distance > reach) continue;
            if (!nearest || distance < nearest->distance) nearest = Obstacle{distance, normal};
        }
        return nearest;
    }

private:
    std::vector<Plane> planes_;
};

const Planes kNothing;
const Planes kFloor({{{0, 0, 0}, {0, 0, 1}}});

Travel runFor(double seconds, int frames, TravelMode mode, const MotionInput& input,
              const TravelOptions& options, const Surroundings& around, Travel state = {}) {
    for (int i = 0; i < frames; ++i)
        state = travelled(state, mode, input, seconds / frames, options, kCompass, around);
    return state;
}

TEST(CameraMotion, AtFullSpeedAWalkerGoesAsFarAsTheOptionsSay) {
    const MotionInput ahead{.move = {0, 1, 0}};
    const TravelOptions options{.speed = 2, .gravity = false};
    const Travel after = runFor(10, 600, TravelMode::walk, ahead, options, kNothing);
    // starting up costs one time constant of the way
    EXPECT_NEAR(after.pose.eye.y, 2 * (10 - Travel::kSmoothing), 1e-6);
    const MotionInput running{.move = {0, 1, 0}, .run = true};
    const Travel ran = runFor(10, 600, TravelMode::walk, running, options, kNothing);
    EXPECT_NEAR(ran.pose.eye.y / after.pose.eye.y, options.runFactor, 1e-9);
    const MotionInput diagonal{.move = {1, 1, 0}};
    const Travel aslant = runFor(10, 600, TravelMode::walk, diagonal, options, kNothing);
    EXPECT_NEAR(glm::length(aslant.pose.eye), after.pose.eye.y, 1e-6);
}

RC_GTEST_PROP(CameraMotion, DoesNotDependOnTheFrameRate, ()) {
    const auto part = [] { return *rc::gen::inRange(-10, 11) / 10.0; };
    MotionInput input{.move = {part(), part(), part()}};
    const TravelOptions options{.gravity = false};
    Travel start;
    start.pose.pitch = part();
    start.velocity = {part(), part(), part()};
    start.dollyLeft = part();
    const auto mode = *rc::gen::element(TravelMode::walk, TravelMode::fly);
    const Travel once = runFor(0.4, 1, mode, input, options, kNothing, start);
    const Travel often = runFor(0.4, 37, mode, input, options, kNothing, start);
    RC_ASSERT(glm::distance(once.pose.eye, often.pose.eye) < 1e-9);
    RC_ASSERT(glm::distance(once.velocity, often.velocity) < 1e-9);
    RC_ASSERT(std::abs(once.dollyLeft - often.dollyLeft) < 1e-9);
}

TEST(CameraMotion, WalkingIsLevelAndFlyingFollowsTheView) {
    const MotionInput ahead{.move = {0, 1, 0}};
    const TravelOptions options{.gravity = false};
    Travel down;
    down.pose.pitch = -1;
    EXPECT_DOUBLE_EQ(runFor(1, 10, TravelMode::walk, ahead, options, kNothing, down).pose.eye.z, 0);
    const auto flown = runFor(1, 10, TravelMode::fly, ahead, options, kNothing, down).pose.eye;
    EXPECT_NEAR(flown.z / glm::length(flown), -std::sin(1.0), 1e-9);
}

TEST(CameraMotion, TheWheelIsGivenInTheEnd) {
    Travel state;
    state = travelled(state, TravelMode::fly, {.dolly = 2}, 0.016, {}, kCompass, kNothing);
    EXPECT_LT(state.pose.eye.y, 0.3) << "not at once";
    state = runFor(2, 100, TravelMode::fly, {}, {}, kNothing, state);
    EXPECT_NEAR(state.pose.eye.y, 2 * TravelOptions{}.dollyStep, 1e-6);
}

TEST(CameraMotion, AWalkerFallsToTheFloorAndStandsThereAtEyeHeight) {
    Travel state;
    state.pose.eye = {0, 0, 1.65 + 4.905}; // a fall of one second
    const Travel half = runFor(0.5, 50, TravelMode::walk, {}, {}, kFloor, state);
    EXPECT_NEAR(half.pose.eye.z, 1.65 + 4.905 - 9.81 * 0.125, 0.02);
    const Travel landed = runFor(1.2, 120, TravelMode::walk, {}, {}, kFloor, state);
    EXPECT_NEAR(landed.pose.eye.z, 1.65, 1e-9);
    EXPECT_DOUBLE_EQ(landed.fall, 0);
    state.pose.eye.z = 1.4; // on a step: up again, softly
    const Travel up = runFor(1, 60, TravelMode::walk, {}, {}, kFloor, state);
    EXPECT_NEAR(up.pose.eye.z, 1.65, 1e-3);
    const Travel weightless = runFor(1, 60, TravelMode::walk, {}, {.gravity = false}, kFloor, half);
    EXPECT_DOUBLE_EQ(weightless.pose.eye.z, half.pose.eye.z);
    const Travel nowhere = runFor(1, 60, TravelMode::walk, {}, {}, kNothing, state);
    EXPECT_DOUBLE_EQ(nowhere.pose.eye.z, 1.4) << "without a floor nobody falls";
}

TEST(CameraMotion, WallsStopAWalkerWhoSlidesAlongThem) {
    const double aslant = std::sqrt(0.5);
    const Planes room({{{0, 2, 0}, {0, -1, 0}}, {{3, 0, 0}, {-aslant, -aslant, 0}}});
    const TravelOptions options{.speed = 5, .gravity = false, .collision = true};
    const MotionInput ahead{.move = {0, 1, 0}};
    const Travel stopped = runFor(3, 90, TravelMode::walk, ahead, options, room);
    EXPECT_NEAR(stopped.pose.eye.y, 2 - options.girth, 1e-3);
    const MotionInput right{.move = {1, 0.2, 0}};
    const Travel slid = runFor(6, 180, TravelMode::walk, right, options, room);
    for (const glm::dvec3 inward : {glm::dvec3(0, -1, 0), glm::dvec3(-aslant, -aslant, 0)}) {
        const glm::dvec3 on = inward.y == -1 ? glm::dvec3(0, 2, 0) : glm::dvec3(3, 0, 0);
        EXPECT_GT(glm::dot(slid.pose.eye - on, inward), options.girth - 1e-3);
    }
    EXPECT_GT(slid.pose.eye.x, 0.9) << "it got on along the wall";
    TravelOptions ghost = options;
    ghost.collision = false;
    EXPECT_GT(runFor(3, 90, TravelMode::walk, ahead, ghost, room).pose.eye.y, 10);
}

TEST(CameraMotion, OrbitingKeepsTheCentreWhereItIsInTheView) {
    Orbit orbit{.pose = {{0, -3, 1}, 0.2, -0.1}, .centre = {0.5, 1, 0.3}};
    const auto inView = [](const Orbit& o) {
        const glm::dvec3 way = o.centre - o.pose.eye, ahead = o.pose.forward(kCompass);
        const glm::dvec3 right = o.pose.right(kCompass);
        return glm::dvec3(glm::dot(way, right), glm::dot(way, glm::cross(right, ahead)),
                          glm::dot(way, ahead));
    };
    const glm::dvec3 before = inView(orbit);
    for (const glm::dvec2 turn : {glm::dvec2(0.7, 0), glm::dvec2(0, -0.6), glm::dvec2(-2, 0.9)}) {
        orbit = orbited(orbit, {.orbit = turn}, 0.01, 0.5, kCompass);
        EXPECT_LT(glm::distance(inView(orbit), before), 1e-9);
    }
    orbit = orbited(orbit, {.orbit = {0, 10}}, 0.01, 0.5, kCompass); // as far as it goes
    EXPECT_LT(glm::distance(inView(orbit), before), 1e-9);
    EXPECT_DOUBLE_EQ(orbit.pose.pitch, CameraPose::kSteepest);
}

TEST(CameraMotion, ZoomingScalesTheDistanceAndPanningCarriesTheCentreAlong) {
    Orbit orbit{.pose = {{0, -3, 0}, 0, 0}, .centre = {0, 1, 0}};
    orbit = orbited(orbit, {.dolly = 5}, 0, 0.5, kCompass);
    for (int i = 0; i < 100; ++i) orbit = orbited(orbit, {}, 0.02, 0.5, kCompass);
    EXPECT_NEAR(glm::distance(orbit.pose.eye, orbit.centre), 4 * std::exp(-5 * Orbit::kZoomStep),
                1e-6);
    const glm::dvec3 arm = orbit.pose.eye - orbit.centre;
    const double width = 2 * 0.5 * glm::length(arm);
    orbit = orbited(orbit, {.pan = {1, 0}}, 0.02, 0.5, kCompass);
    EXPECT_NEAR(orbit.centre.x, width, 1e-9) << "a view's width";
    EXPECT_LT(glm::distance(orbit.pose.eye - orbit.centre, arm), 1e-9);
    for (int i = 0; i < 1000; ++i) orbit = orbited(orbit, {.dolly = 5}, 0.1, 0.5, kCompass);
    EXPECT_GE(glm::distance(orbit.pose.eye, orbit.centre), 0.99 * Orbit::kNearest);
}

} // namespace

} // namespace penumbra
