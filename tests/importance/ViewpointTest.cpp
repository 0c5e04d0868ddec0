// From where, and how large, the viewer sees a piece of the scene.
#include "importance/Viewpoint.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace penumbra {

namespace {

/// At the origin, looking along -Z, 90 degrees wide and as high.
View squareView() {
    Lens lens;
    lens.focalLength = 1;
    lens.horizontalAperture = lens.verticalAperture = 2;
    lens.clippingRange = {0.01f, 1000};
    return makeView(lens, glm::dmat4(1.0), 1000, 1000);
}

Bounds cubeAt(glm::vec3 centre, float half = 0.05f) {
    Bounds box;
    box.add(centre - half), box.add(centre + half);
    return box;
}

TEST(Viewpoint, SaysHowManyPixelsADegreeHas) {
    // 500 pixels to the tangent of 45 degrees: 500 a radian in the middle, 8.73 a degree.
    EXPECT_NEAR(Viewpoint(squareView(), 1000, 1000).pixelsPerDegree(), 8.7266, 1e-3);
}

TEST(Viewpoint, OfAnOrthographicPictureIsThirtyDegreesWide) {
    Lens lens;
    lens.perspective = false;
    lens.horizontalAperture = 40; // tenths: 4 m
    const View view = makeView(lens, glm::dmat4(1.0), 600, 600);
    const Viewpoint viewpoint(view, 600, 600);
    EXPECT_NEAR(viewpoint.pixelsPerDegree(), 300 / std::tan(glm::radians(15.0)) / 57.29578, 1e-3);
    const double edge = glm::dot(viewpoint.through({1, 0}), viewpoint.through({-1, 0}));
    EXPECT_GT(edge, std::cos(glm::radians(30.1)));
    EXPECT_LT(edge, 1);
}

TEST(Viewpoint, TellsThePictureFromItsMarginAndTheRest) {
    using Region = Viewpoint::Region;
    const Viewpoint viewpoint(squareView(), 1000, 1000);
    const auto at = [](double degrees) { // to the right of the axis, 10 m away
        const double angle = glm::radians(degrees);
        return cubeAt({10 * std::sin(angle), 0, -10 * std::cos(angle)});
    };
    EXPECT_EQ(viewpoint.regionOf(at(0)), Region::picture);
    EXPECT_EQ(viewpoint.regionOf(at(44)), Region::picture);
    EXPECT_EQ(viewpoint.regionOf(at(47)), Region::margin);
    EXPECT_EQ(viewpoint.regionOf(at(-59)), Region::margin);
    EXPECT_EQ(viewpoint.regionOf(at(62)), Region::elsewhere);
    EXPECT_EQ(viewpoint.regionOf(at(180)), Region::elsewhere);
}

TEST(Viewpoint, CountsThePixelsOfASquareThatFacesIt) {
    // 0.1 m at 10 m: 5 pixels a side.
    const Viewpoint viewpoint(squareView(), 1000, 1000);
    const Bounds flat{{-0.05f, -0.05f, -10}, {0.05f, 0.05f, -10}};
    EXPECT_NEAR(viewpoint.pixelsOf(flat, {0, 0, 1}, 0.01f), 25, 0.01);
    EXPECT_NEAR(viewpoint.pixelsOf(flat, {0, 0.8f, 0.6f}, 0.01f), 15, 0.01); // turned by 53 degrees
    EXPECT_EQ(viewpoint.pixelsOf(flat, {0, 0, -1}, 0.01f), 0);
}

TEST(Viewpoint, CountsAsManyPixelsAnywhereInThePlaneOfThePicture) {
    const Viewpoint viewpoint(squareView(), 1000, 1000);
    for (const glm::vec3 at : {glm::vec3(8, 0, -10), glm::vec3(-6, 9, -10)})
        EXPECT_NEAR(
            viewpoint.pixelsOf({at - glm::vec3(0.05f, 0.05f, 0), at + glm::vec3(0.05f, 0.05f, 0)},
                               {0, 0, 1}, 0.01f),
            25, 0.01);
}

TEST(Viewpoint, DoesNotStretchWhatIsFarOutOfThePicture) {
    const Viewpoint viewpoint(squareView(), 1000, 1000);
    EXPECT_NEAR(viewpoint.pixelsOf(cubeAt({0, 0, 10}), {0, 0, -1}, 0.01f), 25, 0.1);
}

TEST(Viewpoint, CountsThePixelsOfASphere) {
    // Of radius 0.1 m at 10 m: a disk of 78.5 pixels; its normals cancel out.
    const Viewpoint viewpoint(squareView(), 1000, 1000);
    const auto area = float(4 * std::numbers::pi * 0.01);
    EXPECT_NEAR(viewpoint.pixelsOf(cubeAt({0, 0, -10}, 0.1f), {0, 0, 0}, area), 78.5, 0.1);
}

TEST(Viewpoint, NeverCountsMorePixelsThanThePictureHas) {
    const Viewpoint viewpoint(squareView(), 1000, 1000);
    EXPECT_EQ(viewpoint.pixelsOf(cubeAt({0, 0, -0.1f}, 0.05f), {0, 0, 1}, 100), 1e6);
}

} // namespace

} // namespace penumbra
