// Laws that form factors obey whatever the geometry: closure, additivity, reciprocity.
#include "radiosity/rows/FormFactor.h"
#include "tests/scenegraph/RandomParts.h"
#include "tests/support/Scenes.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numbers>

namespace penumbra {

namespace {

using Polygon = std::vector<glm::vec3>;

/// The six faces of a hexahedron as polygons, counter-clockwise seen from inside.
std::vector<Polygon> facesOf(const std::vector<glm::vec3>& corners) {
    std::vector<Polygon> faces;
    for (const auto& face : kBoxFacesInwards) {
        Polygon& polygon = faces.emplace_back();
        for (std::uint32_t corner : face) polygon.push_back(corners[corner]);
    }
    return faces;
}

double sumOver(const std::vector<Polygon>& faces, glm::vec3 p, glm::vec3 n) {
    double sum = 0;
    for (const Polygon& face : faces) sum += polygonFormFactor(p, n, face);
    return sum;
}

/// A box of a room's proportions, anywhere and turned anyhow.
std::vector<glm::vec3> anyBox() {
    const glm::vec3 size(number(0.2, 10), number(0.2, 10), number(0.2, 10));
    const glm::dmat4 where = place() * rotation();
    std::vector<glm::vec3> corners = boxCorners(-0.5f * size, 0.5f * size);
    for (glm::vec3& corner : corners)
        corner = glm::vec3(where * glm::dvec4(glm::dvec3(corner), 1.0));
    return corners;
}

glm::vec3 normalOf(const Polygon& p) {
    return glm::normalize(glm::cross(p[1] - p[0], p[3] - p[0]));
}

/// The point at (s, t) of a parallelogram.
glm::vec3 at(const Polygon& p, double s, double t) {
    return glm::vec3(glm::dvec3(p[0]) + s * glm::dvec3(p[1] - p[0]) + t * glm::dvec3(p[3] - p[0]));
}

RC_GTEST_PROP(Closure, HoldsOnTheWallsOfABox, ()) {
    const std::vector<Polygon> faces = facesOf(anyBox());
    const Polygon& wall = faces[*rc::gen::inRange<std::size_t>(0, 6)];
    const glm::vec3 p = at(wall, number(0.01, 0.99), number(0.01, 0.99));
    RC_ASSERT(std::abs(sumOver(faces, p, normalOf(wall)) - 1) < 1e-3);
}

/// A point on a wall, 10^-least to 10^-2 of the wall's size away from one edge, perhaps from two.
glm::vec3 nearEdge(const Polygon& wall, double least) {
    const double s = std::pow(10, number(-least, -2));
    const bool corner = *rc::gen::arbitrary<bool>();
    const double t = corner ? std::pow(10, number(-least, -2)) : number(0.01, 0.99);
    return at(wall, s, t);
}

RC_GTEST_PROP(Closure, HoldsAMillionthOfAWallFromItsEdgesAndCorners, ()) {
    const glm::vec3 size(number(0.2, 10), number(0.2, 10), number(0.2, 10));
    const std::vector<Polygon> faces = facesOf(boxCorners(glm::vec3(0), size));
    const Polygon& wall = faces[*rc::gen::inRange<std::size_t>(0, 6)];
    const glm::vec3 p = nearEdge(wall, 6);
    // At the far ends of the box the distance drowns in the rounding of p: from one ulp on it is 0.
    RC_PRE(glm::all(glm::lessThan(p, size - 2e-6f)));
    RC_ASSERT(std::abs(sumOver(faces, p, normalOf(wall)) - 1) < 1e-3);
}

RC_GTEST_PROP(Closure, HoldsCloseToTheEdgesAndCornersOfATurnedBox, ()) {
    // Here the point lies off its wall by rounding, 1e-6 m; a thousandth of a wall is 0.2 mm or
    // more.
    const std::vector<Polygon> faces = facesOf(anyBox());
    const Polygon& wall = faces[*rc::gen::inRange<std::size_t>(0, 6)];
    RC_ASSERT(std::abs(sumOver(faces, nearEdge(wall, 3), normalOf(wall)) - 1) < 5e-3);
}

RC_GTEST_PROP(Closure, HoldsInsideOfABoxWhicheverWayTheReceiverFaces, ()) {
    const std::vector<glm::vec3> corners = anyBox();
    const glm::vec3 p = glm::mix(corners[0], corners[7], float(number(0.05, 0.95)));
    RC_ASSERT(std::abs(sumOver(facesOf(corners), p, glm::vec3(direction())) - 1) < 1e-3);
}

RC_GTEST_PROP(Closure, HoldsForFacesThatAreNotPlanar, ()) {
    // Lambert's sum runs over edges: what two twisted faces share cancels, planar or not.
    std::vector<glm::vec3> corners = boxCorners({-1, -1, -1}, {1, 1, 1});
    for (glm::vec3& corner : corners) corner += point(0.25);
    RC_ASSERT(std::abs(sumOver(facesOf(corners), point(0.2), glm::vec3(direction())) - 1) < 1e-5);
}

RC_GTEST_PROP(FormFactor, OfAPolygonIsTheSumOverItsParts, ()) {
    // A convex polygon on an ellipse, cut along a chord; the horizon may cut it as well.
    const int sides = *rc::gen::inRange(4, 9);
    const double squeeze = number(0.2, 1), phase = number(0, 6.28);
    const glm::vec3 centre(number(-3, 3), number(-3, 3), number(-1, 3));
    const glm::dmat3 turn(rotation());
    Polygon whole;
    for (int i = 0; i < sides; ++i) {
        const double angle = phase + 2 * std::numbers::pi * i / sides;
        whole.push_back(
            centre + glm::vec3(turn * glm::dvec3(std::cos(angle), squeeze * std::sin(angle), 0)));
    }
    const int chord = *rc::gen::inRange(2, sides - 1);
    const Polygon first(whole.begin(), whole.begin() + chord + 1);
    Polygon second(whole.begin() + chord, whole.end());
    second.push_back(whole[0]);
    const auto factor = [](const Polygon& p) { return polygonFormFactor({0, 0, 0}, {0, 0, 1}, p); };
    RC_ASSERT(std::abs(factor(whole) - factor(first) - factor(second)) < 1e-5f);
}

RC_GTEST_PROP(FormFactor, ObeysReciprocityBetweenRectangles, ()) {
    // A1 F12 = A2 F21, both by quadrature of the closed form over the receiving side.
    const auto rectangle = [](float z, bool down) {
        const float x = float(number(-2, 2)), y = float(number(-2, 2));
        const float w = float(number(0.3, 2)), h = float(number(0.3, 2));
        Polygon p{{x, y, z}, {x + w, y, z}, {x + w, y + h, z}, {x, y + h, z}};
        if (down) p = {p[0], p[3], p[2], p[1]};
        return p;
    };
    const Polygon a = rectangle(0, false);
    Polygon b = rectangle(2, true);
    const glm::dmat4 tilt = moved(0, 0, 2.5) *
                            glm::rotate(glm::dmat4(1.0), number(-0.3, 0.3), glm::dvec3(1, 1, 0)) *
                            moved(0, 0, -2);
    for (glm::vec3& p : b) p = glm::vec3(tilt * glm::dvec4(glm::dvec3(p), 1.0));
    const auto exchange = [](const Polygon& from, const Polygon& to) {
        constexpr int kPoints = 24;
        double sum = 0;
        for (int i = 0; i < kPoints; ++i)
            for (int j = 0; j < kPoints; ++j)
                sum += polygonFormFactor(at(from, (i + 0.5) / kPoints, (j + 0.5) / kPoints),
                                         normalOf(from), to);
        return sum / (kPoints * kPoints) *
               double(glm::length(glm::cross(from[1] - from[0], from[3] - from[0])));
    };
    const double there = exchange(a, b), back = exchange(b, a);
    RC_ASSERT(std::abs(there - back) < 1e-3 * std::max(there, back));
}

RC_GTEST_PROP(FormFactor, OfADiskIsThatOfAPolygonOfManySides, ()) {
    // 2000 sides: their error is below 1e-5. A disk that the horizon cuts is itself taken as a
    // polygon, of 48 sides; close to such a disk's rim that shows in the fourth digit.
    const glm::vec3 centre(number(-2, 2), number(-2, 2), number(-0.5, 2));
    const glm::vec3 axis(direction());
    const float radius = float(number(0.1, 1.5));
    const glm::vec3 u = glm::normalize(
        glm::cross(axis, std::abs(axis.x) < 0.7f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0)));
    const glm::vec3 v = glm::cross(axis, u);
    constexpr int kSides = 2000;
    Polygon polygon;
    for (int i = 0; i < kSides; ++i) {
        const double angle = 2 * std::numbers::pi * i / kSides;
        polygon.push_back(centre +
                          radius * (float(std::cos(angle)) * u + float(std::sin(angle)) * v));
    }
    const float expected = polygonFormFactor({0, 0, 0}, {0, 0, 1}, polygon);
    const bool cut = centre.z < radius * std::sqrt(1 - axis.z * axis.z);
    RC_ASSERT(std::abs(diskFormFactor({0, 0, 0}, {0, 0, 1}, centre, axis, radius) - expected) <
              (cut ? 2e-3f : 2e-5f));
}

RC_GTEST_PROP(FormFactor, IsBetweenNothingAndTheWholeHemisphere, ()) {
    // Four points anywhere, as files hold them: twisted, crossing, behind.
    const Polygon polygon{point(), point(), point(), point()};
    const float factor = polygonFormFactor(point(), glm::vec3(direction()), polygon);
    RC_ASSERT(factor >= 0);
    RC_ASSERT(factor <= 1.0001f);
}

TEST(FormFactor, OfASphereThatTheHorizonCutsIsHalfWhenItsCentreLiesOnIt) {
    // A sphere of radius 1 whose centre, 2 away, lies on the horizon. Seen from p it is the cone of
    // half angle w = asin(1/2), and F = (w - sin w cos w) / pi, Howell B-39 at elevation 0.
    const double w = std::asin(0.5);
    EXPECT_NEAR(sphereFormFactor({0, 0, 0}, {0, 0, 1}, {2, 0, 0}, 1),
                (w - std::sin(w) * std::cos(w)) / std::numbers::pi, 1e-4);
}

TEST(FormFactor, FromTheBackIsZero) {
    const Polygon up{{-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}};
    EXPECT_EQ(polygonFormFactor({0, 0, 0}, {0, 0, 1}, up), 0);
    EXPECT_LT(pointToPolygonFormFactor({0, 0, 0}, {0, 0, 1}, up), 0);
    EXPECT_EQ(diskFormFactor({0, 0, 0}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}, 1), 0);
    EXPECT_EQ(polygonFormFactor({0, 0, 2}, {0, 0, 1}, up), 0); // below the horizon
    EXPECT_EQ(sphereFormFactor({0, 0, 0}, {0, 0, 1}, {0, 0, -3}, 1), 0);
}

} // namespace

} // namespace penumbra
