// Polygons in triangles: the same area, nothing twice.
#include "radiosity/surface/Triangulate.h"
#include "radiosity/mesh/Emitters.h"
#include "radiosity/surface/SurfaceMesh.h"
#include "tests/scenegraph/RandomParts.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <numbers>
#include <numeric>

namespace penumbra {

namespace {

using Points = std::vector<glm::vec3>;

std::vector<std::uint32_t> allOf(const Points& points) {
    std::vector<std::uint32_t> corners(points.size());
    std::iota(corners.begin(), corners.end(), 0u);
    return corners;
}

/// Sum of the triangles' areas, each counted along the polygon's normal: less than the sum of their
/// sizes if one is turned over.
double signedArea(const Points& points,
                  const std::vector<std::array<std::uint32_t, 3>>& triangles) {
    const glm::dvec3 normal = glm::normalize(newellNormal(points, allOf(points)));
    double area = 0;
    for (const auto& t : triangles) area += 0.5 * glm::dot(normal, newellNormal(points, t));
    return area;
}

double size(const Points& points, const std::vector<std::array<std::uint32_t, 3>>& triangles) {
    double area = 0;
    for (const auto& t : triangles) area += 0.5 * glm::length(newellNormal(points, t));
    return area;
}

double areaOf(const Points& points) {
    return 0.5 * glm::length(newellNormal(points, allOf(points)));
}

void expectWhole(const Points& points) {
    const auto triangles = triangulate(points, allOf(points));
    EXPECT_EQ(triangles.size(), points.size() - 2);
    EXPECT_NEAR(signedArea(points, triangles), areaOf(points), 1e-5 * areaOf(points));
    EXPECT_NEAR(size(points, triangles), areaOf(points), 1e-5 * areaOf(points));
}

const Points kL{{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}};
const Points kU{{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {2, 3, 0},
                {2, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}};
// A square with a square hole, joined by a bridge that is gone along twice.
const Points kHole{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {0, 0, 0},
                   {1, 1, 0}, {1, 3, 0}, {3, 3, 0}, {3, 1, 0}, {1, 1, 0}};

RC_GTEST_PROP(Triangulate, KeepsTheAreaOfAnySimplePolygon, ()) {
    // Seen from its middle a polygon with growing angles never crosses itself, however jagged.
    const int sides = *rc::gen::inRange(3, 24);
    const glm::dmat4 where = place() * rotation();
    Points points;
    for (int i = 0; i < sides; ++i) {
        const double angle = 2 * std::numbers::pi * (i + number(0, 0.8)) / sides;
        const double radius = number(0.1, 3);
        points.emplace_back(glm::vec3(
            where * glm::dvec4(radius * std::cos(angle), radius * std::sin(angle), 0, 1)));
    }
    const auto triangles = triangulate(points, allOf(points));
    RC_ASSERT(triangles.size() == points.size() - 2);
    // The star may be so thin that its middle lies outside: then areas still agree.
    const double area = areaOf(points);
    RC_ASSERT(std::abs(signedArea(points, triangles) - area) < 1e-4);
    RC_ASSERT(std::abs(size(points, triangles) - area) < 1e-4);
}

TEST(Triangulate, KeepsTheAreaOfConcaveShapes) {
    expectWhole(kL);
    expectWhole(kU);
}

TEST(Triangulate, KeepsTheAreaAroundAHoleWithABridge) {
    ASSERT_DOUBLE_EQ(areaOf(kHole), 12);
    expectWhole(kHole);
}

TEST(Triangulate, TakesPolygonsInAnyDirectionAndWinding) {
    for (const Points& shape : {kL, kU, kHole}) {
        Points turned;
        for (glm::vec3 p : shape) turned.emplace_back(p.z + 1, p.x - 2, p.y + 3);
        expectWhole(turned);
        std::reverse(turned.begin(), turned.end());
        expectWhole(turned);
    }
}

TEST(Triangulate, ReturnsSomethingForAPolygonThatCrossesItself) {
    const Points bow{{0, 0, 0}, {2, 1, 0}, {2, 0, 0}, {0, 3, 0}, {1, 5, 0}};
    EXPECT_EQ(triangulate(bow, allOf(bow)).size(), 3u);
}

TEST(Triangulate, UsesTheCornersItIsGiven) {
    const Points points{{9, 9, 9}, {0, 0, 0}, {1, 0, 0}, {8, 8, 8}, {1, 1, 0}, {0, 1, 0}};
    for (const auto& triangle : triangulate(points, std::array<std::uint32_t, 4>{1, 2, 4, 5}))
        for (std::uint32_t corner : triangle) EXPECT_TRUE(corner != 0 && corner != 3);
}

TEST(IsConvex, TellsConvexFromConcaveAndTwiceRound) {
    const Points square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    const Points midpoint{{0, 0, 0}, {0.5f, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    EXPECT_TRUE(isConvex(square, allOf(square)));
    EXPECT_TRUE(isConvex(midpoint, allOf(midpoint))); // a corner in the middle of an edge
    EXPECT_FALSE(isConvex(kL, allOf(kL)));
    EXPECT_FALSE(isConvex(kU, allOf(kU)));
    Points star;
    for (int i = 0; i < 5; ++i) // a pentagram turns left at every corner, but twice round
        star.emplace_back(std::cos(4 * std::numbers::pi * i / 5),
                          std::sin(4 * std::numbers::pi * i / 5), 0);
    EXPECT_FALSE(isConvex(star, allOf(star)));
}

} // namespace

} // namespace penumbra
