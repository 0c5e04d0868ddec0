#include "scenegraph/Frustum.h"

#include "RandomParts.h"
#include "scenegraph/Camera.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace penumbra {

namespace {

Bounds cubeAround(glm::vec3 centre, float half) {
    return {centre - half, centre + half};
}

/// At the origin, looking along -Z, 90 degrees wide and high, from 1 m to 100 m.
Frustum plainView() {
    Lens lens;
    lens.focalLength = 1;
    lens.horizontalAperture = 2;
    lens.clippingRange = {1, 100};
    return Frustum(makeView(lens, glm::dmat4(1.0), 100, 100).worldToClip());
}

TEST(Frustum, KeepsABoxInFront) {
    EXPECT_TRUE(plainView().mayContain(cubeAround({0, 0, -5}, 1)));
}

TEST(Frustum, KeepsABoxAroundTheEye) {
    EXPECT_TRUE(plainView().mayContain(cubeAround({0, 0, 0}, 500)));
}

TEST(Frustum, CullsWhatIsBehindEachOfItsPlanes) {
    EXPECT_FALSE(plainView().mayContain(cubeAround({0, 0, 5}, 1))) << "behind the eye";
    EXPECT_FALSE(plainView().mayContain(cubeAround({0, 0, -0.5f}, 0.4f))) << "nearer than near";
    EXPECT_FALSE(plainView().mayContain(cubeAround({0, 0, -102}, 1))) << "farther than far";
    EXPECT_FALSE(plainView().mayContain(cubeAround({-13, 0, -10}, 1))) << "left";
    EXPECT_FALSE(plainView().mayContain(cubeAround({13, 0, -10}, 1))) << "right";
    EXPECT_FALSE(plainView().mayContain(cubeAround({0, -13, -10}, 1))) << "below";
    EXPECT_FALSE(plainView().mayContain(cubeAround({0, 13, -10}, 1))) << "above";
}

TEST(Frustum, CullsAnEmptyBox) {
    EXPECT_FALSE(plainView().mayContain(Bounds()));
}

View randomView() {
    Lens lens;
    lens.perspective = *rc::gen::arbitrary<bool>();
    lens.focalLength = float(number(5, 100));
    lens.horizontalAperture = float(number(5, 200));
    lens.clippingRange = {float(number(0.01, 1)), float(number(2, 100))};
    return makeView(lens, orthogonalFrame(), *rc::gen::inRange(100, 2000),
                    *rc::gen::inRange(100, 2000));
}

RC_GTEST_PROP(Frustum, NeverCullsABoxWithAVisiblePoint, ()) {
    const View view = randomView();
    // A point of the view volume, from clip space back to the world; the box holds it.
    const glm::dvec4 clip(number(-0.99, 0.99), number(-0.99, 0.99), number(-0.99, 0.99), 1);
    const glm::dvec4 world = glm::inverse(view.worldToClip()) * clip;
    const glm::vec3 visible(world / world.w);
    Bounds box;
    box.add(visible);
    box.add(visible + point(3));
    RC_ASSERT(Frustum(view.worldToClip()).mayContain(box));
}

RC_GTEST_PROP(Frustum, CullsABoxBehindTheEye, ()) {
    const View view = randomView();
    const glm::dvec3 backwards(glm::inverse(view.worldToCamera)[2]); // the camera looks along -Z
    const glm::dvec3 half(number(0, 3), number(0, 3), number(0, 3));
    const double reach = glm::length(half) + number(0.01, 10); // so that no corner is in front
    const glm::dvec3 centre = view.eye + reach * backwards;
    const Bounds box{glm::vec3(centre - half), glm::vec3(centre + half)};
    RC_ASSERT(!Frustum(view.worldToClip()).mayContain(box));
}

} // namespace

} // namespace penumbra
