// Rigid motions separated from stretches.
#include "radiosity/mesh/Pose.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

namespace penumbra {

namespace {

glm::dmat4 matrixOf(const Placement& placement) {
    glm::dmat4 matrix(placement.pose.rotation * placement.stretch);
    matrix[3] = glm::dvec4(placement.pose.translation, 1);
    return matrix;
}

double largestDifference(const glm::dmat4& a, const glm::dmat4& b) {
    double most = 0;
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r) most = std::max(most, std::abs(a[c][r] - b[c][r]));
    return most;
}

class RandomMotions {
public:
    glm::dmat4 next() {
        const glm::dvec3 axis(number(), number(), number());
        const glm::dvec3 way(number(), number(), number());
        return glm::rotate(glm::translate(glm::dmat4(1.0), 5.0 * way), 7 * number(),
                           glm::normalize(axis + glm::dvec3(1e-3)));
    }

private:
    double number() { return 2.0 * random_() / double(0xffffffffu) - 1; } // in [-1, 1]
    std::mt19937 random_;
};

/// Frames that objects hang in: scaled, mirrored, sheared, a centimetre file, a flattened one.
std::array<glm::dmat4, 8> frames() {
    const auto scale = [](double x, double y, double z) {
        return glm::scale(glm::dmat4(1.0), glm::dvec3(x, y, z));
    };
    glm::dmat4 shear(1.0), both = scale(0.3, 1.7, 0.9);
    shear[1][0] = 0.7;
    both[2][1] = -0.4;
    return {glm::dmat4(1.0),        scale(0.5, 0.5, 0.5),    scale(1, 2, 3),
            scale(-1, 1, 1),        scale(0.01, 0.01, 0.01), shear,
            scale(-1, 1, 1) * both, scale(1, 1, 1e-3)};
}

TEST(Pose, TheStretchIsTheSameBitsWhereverAFrameIsMovedTo) {
    for (const glm::dmat4& frame : frames()) {
        const glm::dmat3 stretch = placementOf(frame).stretch;
        RandomMotions motions;
        for (int i = 0; i < 2000; ++i)
            ASSERT_EQ(placementOf(motions.next() * frame).stretch, stretch) << "motion " << i;
    }
}

TEST(Pose, TheStretchIsTheSameBitsAfterThousandsOfMotionsOnTopOfEachOther) {
    // A viewer multiplies what the hand does onto the matrix: rounding errors add up.
    for (const glm::dmat4& frame : frames()) {
        const glm::dmat3 stretch = placementOf(frame).stretch;
        RandomMotions motions;
        glm::dmat4 now = frame;
        for (int i = 0; i < 5000; ++i) {
            const glm::dmat4 motion = motions.next();
            now = motion * now;
            now[3] = glm::dvec4(glm::dvec3(motion[3]), 1);
            ASSERT_EQ(placementOf(now).stretch, stretch) << "after " << i + 1 << " motions";
        }
    }
}

TEST(Pose, ScaledMirroredAndShearedFramesAreReproduced) {
    // The stretch is rounded to 30 bits of its largest entry: 1e-9 of it, nanometres in a room.
    for (const glm::dmat4& frame : frames()) {
        RandomMotions motions;
        for (int i = 0; i < 100; ++i) {
            const glm::dmat4 matrix = motions.next() * frame;
            const Placement placement = placementOf(matrix);
            EXPECT_LT(largestDifference(matrixOf(placement), matrix), 6e-9);
            EXPECT_GT(glm::determinant(placement.pose.rotation), 0) << "mirroring is the stretch's";
        }
    }
}

TEST(Pose, AFrameThatOnlyPlacesIsKeptExactly) {
    EXPECT_EQ(placementOf(glm::dmat4(1.0)).pose, Pose());
    RandomMotions motions;
    for (int i = 0; i < 1000; ++i) {
        const glm::dmat4 motion = motions.next();
        const Placement placement = placementOf(motion);
        ASSERT_EQ(placement.stretch, glm::dmat3(1.0));
        ASSERT_EQ(matrixOf(placement), motion);
    }
}

TEST(Pose, ASingularFrameIsItsOwnStretch) {
    const glm::dmat4 flat = glm::scale(glm::dmat4(1.0), glm::dvec3(1, 0, 1));
    EXPECT_EQ(placementOf(flat).stretch, glm::dmat3(flat));
    EXPECT_EQ(placementOf(flat).pose.rotation, glm::dmat3(1.0));
}

TEST(Pose, InverseUndoesPoint) {
    RandomMotions motions;
    for (int i = 0; i < 1000; ++i) {
        const Pose pose = placementOf(motions.next()).pose;
        const glm::vec3 p(motions.next()[3]);
        EXPECT_LT(glm::length(pose.inverse(pose.point(p)) - p), 4e-6f); // floats of some metres
    }
}

} // namespace

} // namespace penumbra
