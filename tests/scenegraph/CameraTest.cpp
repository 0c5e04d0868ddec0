#include "scenegraph/Camera.h"

#include "RandomParts.h"
#include "SceneParts.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

namespace penumbra {

namespace {

/// Where a point of the world is in the picture: [-1, 1] from left to right, bottom to top,
/// near to far.
glm::dvec3 onScreen(const View& view, glm::dvec3 point) {
    const glm::dvec4 clip = view.worldToClip() * glm::dvec4(point, 1);
    return glm::dvec3(clip) / clip.w;
}

/// Horizontal field of view [degrees].
double fieldOfView(const Lens& lens) {
    const View view = makeView(lens, glm::dmat4(1.0), 300, 200);
    return 2 * glm::degrees(std::atan(1 / view.projection[0][0]));
}

Lens wideLens() {
    Lens lens;
    lens.focalLength = 1;
    lens.horizontalAperture = 2;
    lens.clippingRange = {1, 100};
    return lens;
}

TEST(Camera, FieldOfViewIsTwiceTheArcTangentOfHalfApertureOverFocalLength) {
    Lens lens;
    EXPECT_NEAR(fieldOfView(lens), 23.670, 1e-3); // 2 atan(20.955 / 100), USD's fallback lens
    lens.horizontalAperture = 36;
    lens.focalLength = 18;
    EXPECT_NEAR(fieldOfView(lens), 90, 1e-6);
}

TEST(Camera, LooksAlongMinusZWithYUp) {
    const View view = makeView(wideLens(), moved(0, 0, 10), 100, 100);
    EXPECT_EQ(view.eye, glm::dvec3(0, 0, 10));
    EXPECT_NEAR(onScreen(view, {0, 0, 0}).x, 0, 1e-12);
    EXPECT_NEAR(onScreen(view, {10, 0, 0}).x, 1, 1e-12);
    EXPECT_NEAR(onScreen(view, {0, 10, 0}).y, 1, 1e-12);
    EXPECT_NEAR(onScreen(view, {0, 0, 9}).z, -1, 1e-12);
    EXPECT_NEAR(onScreen(view, {0, 0, -90}).z, 1, 1e-12);
}

TEST(Camera, PixelsAreSquareWhateverTheShapeOfThePicture) {
    const View view = makeView(wideLens(), glm::dmat4(1.0), 400, 100);
    EXPECT_NEAR(onScreen(view, {10, 0, -10}).x, 1, 1e-12);
    EXPECT_NEAR(onScreen(view, {0, 2.5, -10}).y, 1, 1e-12);
}

TEST(Camera, AnApertureOffsetShiftsTheFilm) {
    Lens lens = wideLens();
    lens.horizontalApertureOffset = 1; // half of the aperture: the axis is at the left edge
    EXPECT_NEAR(onScreen(makeView(lens, glm::dmat4(1.0), 100, 100), {0, 0, -10}).x, -1, 1e-12);
}

TEST(Camera, ScaleLeavesTheFieldOfViewAndScalesTheClippingRange) {
    const View plain = makeView(wideLens(), glm::dmat4(1.0), 100, 100);
    const View small = makeView(wideLens(), scaled(0.01), 100, 100);
    EXPECT_NEAR(small.projection[0][0], plain.projection[0][0], 1e-12);
    EXPECT_NEAR(glm::determinant(small.worldToCamera), 1, 1e-12);
    EXPECT_NEAR(onScreen(small, {0, 0, -0.01}).z, -1, 1e-9);
    EXPECT_NEAR(onScreen(small, {0, 0, -1}).z, 1, 1e-9);
}

TEST(Camera, ANearPlaneOfZeroIsMovedInFrontOfTheEye) {
    Lens lens = wideLens();
    lens.clippingRange = {0, 100};
    const View view = makeView(lens, glm::dmat4(1.0), 100, 100);
    EXPECT_TRUE(std::isfinite(onScreen(view, {0, 0, -1}).z));
    EXPECT_LT(onScreen(view, {0, 0, -1}).z, onScreen(view, {0, 0, -2}).z);
}

TEST(Camera, AnOrthographicViewIsATenthOfItsApertureWideInLocalUnits) {
    Lens lens = wideLens();
    lens.perspective = false;
    lens.horizontalAperture = 40; // 4 local units
    const View metres = makeView(lens, glm::dmat4(1.0), 100, 100);
    EXPECT_NEAR(onScreen(metres, {2, 0, -5}).x, 1, 1e-12);
    EXPECT_NEAR(onScreen(metres, {2, 0, -50}).x, 1, 1e-12);
    const View centimetres = makeView(lens, scaled(0.01), 100, 100);
    EXPECT_NEAR(onScreen(centimetres, {0.02, 0, -0.5}).x, 1, 1e-9);
}

/// Whether the picture can be taken back to the scene: its corners, near and far, are somewhere,
/// and the near ones, where rays begin, differ in single precision.
bool canBeUndone(const View& view) {
    const glm::dmat4 back = glm::inverse(view.worldToClip());
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec4 p =
            back * glm::dvec4(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1, 1);
        const glm::vec3 point(glm::dvec3(p) / p.w);
        if (!(glm::length(glm::dvec3(point)) < (corner & 4 ? 1e30 : 1e18))) return false;
    }
    return true;
}

TEST(Camera, CanBeLookedThroughWhateverItsLens) {
    for (const bool perspective : {true, false})
        for (const float value : {0.0f, 1e-30f, 1.0f, 1e15f, 1e17f, 3e38f, std::nanf("")}) {
            Lens narrow = wideLens(), wide = wideLens(), aside = wideLens(), deep = wideLens();
            for (Lens* lens : {&narrow, &wide, &aside, &deep}) lens->perspective = perspective;
            narrow.focalLength = value;
            wide.horizontalAperture = value;
            aside.verticalApertureOffset = value;
            for (const Lens& lens : {narrow, wide, aside}) {
                EXPECT_TRUE(canBeUndone(makeView(lens, moved(1, 2, 3), 300, 200))) << value;
            }
            for (const glm::vec2 range : {glm::vec2(1, value), glm::vec2(value, 3e38f)}) {
                deep.clippingRange = range;
                EXPECT_TRUE(canBeUndone(makeView(deep, moved(1, 2, 3), 300, 200))) << value;
                EXPECT_EQ(whatIsAmiss(deep, moved(1, 2, 3)), "");
            }
        }
    Lens lens = wideLens();
    lens.focalLength = 1e-30f;
    EXPECT_NE(whatIsAmiss(lens, moved(1, 2, 3)), "");
}

TEST(Camera, MakesUpTheAxesThatASingularTransformHasLost) {
    const glm::dmat4 place = glm::rotate(moved(1, 2, 3), 0.7, glm::dvec3(0.1, 0.8, 0.3));
    EXPECT_EQ(wholeFrame(place), place);
    EXPECT_EQ(whatIsAmiss(wideLens(), place), "");
    const View sound = makeView(wideLens(), place, 300, 200);
    for (int axis = 0; axis < 3; ++axis) { // two tell the third
        glm::dmat4 flat = place;
        flat[axis] = glm::dvec4(0);
        const View view = makeView(wideLens(), flat, 300, 200);
        for (glm::dvec3 p : {glm::dvec3(1, 0, -9), glm::dvec3(-3, 2, -5)})
            EXPECT_LT(glm::distance(onScreen(view, p), onScreen(sound, p)), 1e-9) << axis;
        EXPECT_NE(whatIsAmiss(wideLens(), flat), "");
    }
    for (int left = -1; left < 3; ++left) {
        glm::dmat4 line = place;
        for (int axis = 0; axis < 3; ++axis)
            if (axis != left) line[axis] = glm::dvec4(0);
        EXPECT_TRUE(canBeUndone(makeView(wideLens(), line, 300, 200))) << left;
    }
}

TEST(Camera, AHeadThatTurnsToTheLeftSeesThereWhatWasAtItsLeft) {
    glm::dmat4 place(1.0); // looks along +y, z is up
    place[1] = {0, 0, 1, 0}, place[2] = {0, -1, 0, 0}, place[3] = {2, 3, 1, 1};
    const View ahead = makeView(wideLens(), place, 300, 200);
    const View left = turned(ahead, {0, 0, 1}, 90);
    for (double height : {1.0, 1.5}) {
        const glm::dvec3 before = onScreen(ahead, {2, 8, height});
        const glm::dvec3 after = onScreen(left, {-3, 3, height}); // as far away, at the left
        EXPECT_NEAR(glm::length(after - before), 0, 1e-9);
    }
    EXPECT_EQ(left.eye, ahead.eye);
}

RC_GTEST_PROP(FrameBox, ShowsTheWholeBox, ()) {
    const Bounds shown = box();
    const int up = *rc::gen::element(1, 2);
    const View view = frameBox(shown.lower, shown.upper, up, *rc::gen::inRange(50, 2000),
                               *rc::gen::inRange(50, 2000));
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 p = onScreen(view, {corner & 1 ? shown.upper.x : shown.lower.x,
                                             corner & 2 ? shown.upper.y : shown.lower.y,
                                             corner & 4 ? shown.upper.z : shown.lower.z});
        RC_ASSERT(glm::all(glm::lessThan(glm::abs(p), glm::dvec3(1 + 1e-6))));
    }
}

RC_GTEST_PROP(FrameBox, KeepsTheUpAxisUpright, ()) {
    const Bounds shown = box();
    const int up = *rc::gen::element(1, 2);
    const View view = frameBox(shown.lower, shown.upper, up, 160, 90);
    glm::dvec4 upAxis(0);
    upAxis[up] = 1;
    const glm::dvec4 inPicture = view.worldToCamera * upAxis;
    RC_ASSERT(std::abs(inPicture.x) < 1e-6);
    RC_ASSERT(inPicture.y > 0);
}

} // namespace

} // namespace penumbra
