// What the viewer looks at, and how fast sight falls off around it.
#include "importance/Gaze.h"

#include <gtest/gtest.h>

#include <cmath>

namespace penumbra {

namespace {

/// At the origin, looking along -Z, 90 degrees wide and as high.
Viewpoint squareViewpoint() {
    Lens lens;
    lens.focalLength = 1;
    lens.horizontalAperture = lens.verticalAperture = 2;
    return Viewpoint(makeView(lens, glm::dmat4(1.0), 1000, 1000), 1000, 1000);
}

glm::dvec3 rightBy(double degrees) {
    return {std::sin(glm::radians(degrees)), 0, -std::cos(glm::radians(degrees))};
}

TEST(Gaze, IsTheMiddleOfThePictureWhenNothingElseIsKnown) {
    const Gaze gaze(squareViewpoint());
    EXPECT_NEAR(gaze.eccentricity({0, 0, -1}), 0, 1e-5);
    EXPECT_NEAR(gaze.eccentricity(rightBy(30)), 30, 1e-5);
    EXPECT_NEAR(gaze.eccentricity({0, 0, 1}), 180, 1e-5);
}

TEST(Gaze, IsAlsoOnWhatIsDragged) {
    const Gaze gaze(squareViewpoint(), {.point = {}, .dragged = 7.0 * rightBy(40)});
    EXPECT_NEAR(gaze.eccentricity(rightBy(40)), 0, 1e-5);
    EXPECT_NEAR(gaze.eccentricity(rightBy(30)), 10, 1e-5);
    EXPECT_NEAR(gaze.eccentricity(rightBy(-5)), 5, 1e-5); // nearer to the middle
}

TEST(Gaze, IsWhereTheApplicationSaysWhateverIsDragged) {
    const Gaze gaze(squareViewpoint(),
                    {.point = glm::dvec2(1, 0), .dragged = glm::dvec3(0, 0, -1)});
    EXPECT_NEAR(gaze.eccentricity(rightBy(45)), 0, 1e-5);
    EXPECT_NEAR(gaze.eccentricity(rightBy(0)), 45, 1e-5);
}

TEST(PeripheralSensitivity, IsWholeNearTheGazeAndFallsAsFlickerDetectionDoes) {
    EXPECT_EQ(peripheralSensitivity(0), 1);
    EXPECT_EQ(peripheralSensitivity(10), 1);
    // elaTCSF: 10^(-0.0331 e), that is half after 9.09 degrees.
    EXPECT_NEAR(peripheralSensitivity(10 + 9.0945), 0.5, 1e-4);
    EXPECT_EQ(peripheralSensitivity(180), peripheralSensitivity(60));
    EXPECT_NEAR(peripheralSensitivity(60), 0.0221, 1e-4);
}

} // namespace

} // namespace penumbra
