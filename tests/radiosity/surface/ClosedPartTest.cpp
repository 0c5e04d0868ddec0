// Points in and out of closed surfaces.
#include "radiosity/surface/ClosedPart.h"
#include "radiosity/mesh/Emitters.h"
#include "radiosity/surface/SurfaceMesh.h"
#include "scenegraph/Light.h"

#include <gtest/gtest.h>

namespace penumbra {

namespace {

/// A ball of radius 1 of 288 faces.
ClosedPart ball() {
    const MeshData data = lightShapeMesh(Light("ball", SphereShape{1}, Rgb(1.0f)));
    return closedParts(placeSurface(data, glm::dmat4(1.0))).at(0);
}

std::vector<glm::vec3> spiral(float radius) {
    std::vector<glm::vec3> points;
    for (int i = 0; i < 5000; ++i) {
        const float z = 1 - (float(i) + 0.5f) / 2500, r = std::sqrt(1 - z * z);
        points.push_back(
            radius * glm::vec3(r * std::cos(2.4f * float(i)), r * std::sin(2.4f * float(i)), z));
    }
    return points;
}

TEST(ClosedPart, HoldsNoneOfManyPointsThatLieOnItsOutside) {
    EXPECT_FALSE(ball().containsAny(spiral(1.001f)));
}

TEST(ClosedPart, FindsTheOnePointOfManyThatLiesInside) {
    const ClosedPart part = ball();
    const std::vector<glm::vec3> outside = spiral(1.001f);
    for (const glm::vec3 inside : spiral(0.97f)) {
        if (int(inside.z * 1e5f) % 50 != 0) continue;
        std::vector<glm::vec3> points = outside;
        points.insert(points.begin() + 700, inside);
        EXPECT_TRUE(part.containsAny(points)) << inside.x << ' ' << inside.y << ' ' << inside.z;
        EXPECT_TRUE(part.containsAny(std::array{inside}));
    }
}

TEST(ClosedPart, HoldsNothingWhenThereIsNothing) {
    EXPECT_FALSE(ball().containsAny({}));
}

} // namespace

} // namespace penumbra
