// Poses without roll.
#include "viewer/input/CameraPose.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <numbers>

namespace penumbra {

namespace {

constexpr double kPi = std::numbers::pi;

void expectNear(const glm::dvec3& a, const glm::dvec3& b, double tolerance = 1e-12) {
    EXPECT_LT(glm::distance(a, b), tolerance)
        << a.x << ' ' << a.y << ' ' << a.z << " for " << b.x << ' ' << b.y << ' ' << b.z;
}

TEST(CameraPose, LooksNorthLevelAndTurnsEast) {
    const Compass z(UpAxis::z);
    expectNear(CameraPose{}.forward(z), {0, 1, 0});
    expectNear(CameraPose{.heading = kPi / 2}.forward(z), {1, 0, 0});
    const Compass y(UpAxis::y);
    expectNear(CameraPose{}.forward(y), {0, 0, -1});
    expectNear(CameraPose{.heading = kPi / 2}.forward(y), {1, 0, 0});
    expectNear(CameraPose{.pitch = kPi / 4}.forward(y), {0, std::sqrt(0.5), -std::sqrt(0.5)});
}

TEST(CameraPose, ComesBackFromItsMatrix) {
    for (const UpAxis axis : {UpAxis::y, UpAxis::z}) {
        const Compass compass(axis);
        const CameraPose pose{{1, 2, 3}, 2.5, -0.7};
        const CameraPose back = poseOf(pose.toWorld(compass), compass);
        expectNear(back.eye, pose.eye);
        EXPECT_NEAR(back.heading, pose.heading, 1e-12);
        EXPECT_NEAR(back.pitch, pose.pitch, 1e-12);
    }
}

TEST(CameraPose, OfACameraThatLooksStraightDownHasItsHeading) {
    const Compass compass(UpAxis::z);
    // looks down, its upper edge towards east
    const glm::dmat4 down =
        glm::inverse(glm::lookAt(glm::dvec3(0, 0, 5), glm::dvec3(0), glm::dvec3(1, 0, 0)));
    const CameraPose pose = poseOf(down, compass);
    EXPECT_NEAR(pose.heading, kPi / 2, 1e-9);
    EXPECT_DOUBLE_EQ(pose.pitch, -CameraPose::kSteepest);
}

TEST(CameraPose, TurnsTheShorterWay) {
    const CameraPose from{.heading = 0.9 * kPi}, to{.heading = -0.9 * kPi};
    EXPECT_NEAR(between(from, to, 0.5).heading, kPi, 1e-12);
    EXPECT_NEAR(between(from, to, 1).heading, 1.1 * kPi, 1e-12);
}

} // namespace

} // namespace penumbra
