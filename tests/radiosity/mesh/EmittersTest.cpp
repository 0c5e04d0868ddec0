// Lights as senders: area, flux, direction.
#include "radiosity/mesh/Emitters.h"
#include "radiosity/rows/FormFactor.h"
#include "tests/support/BallData.h"
#include "tests/support/Scenes.h"

#include <gtest/gtest.h>

#include <numbers>

namespace penumbra {

namespace {

constexpr double kPi = std::numbers::pi;

Emitter emitterOf(const LightShape& shape, const glm::dmat4& toWorld = glm::dmat4(1.0)) {
    return lightEmitter(Light("lamp", shape, {1, 2, 3}), toWorld);
}

glm::dmat4 stretched(double x, double y, double z) {
    return glm::scale(glm::dmat4(1.0), glm::dvec3(x, y, z));
}

TEST(LightShapes, HaveTheAreaOfTheirShape) {
    EXPECT_NEAR(emitterOf(RectShape{2, 3}).area, 6, 1e-6);
    EXPECT_NEAR(emitterOf(DiskShape{0.5f}).area, kPi / 4, 1e-6);
    EXPECT_NEAR(emitterOf(SphereShape{0.5f}).area, kPi, 1e-6);
}

TEST(LightShapes, GrowWithTheirFrame) {
    EXPECT_NEAR(emitterOf(RectShape{2, 3}, stretched(2, 0.5, 1)).area, 6, 1e-5);
    EXPECT_NEAR(emitterOf(DiskShape{0.5f}, stretched(2, 2, 1)).area, kPi, 1e-5);
    EXPECT_NEAR(emitterOf(SphereShape{0.5f}, stretched(2, 2, 2)).area, 4 * kPi, 1e-5);
}

TEST(LightShapes, StretchedUnevenlyBecomePolygonsOfNearlyTheirArea) {
    // An ellipse in 64 corners: pi a b less 0.16 %; an ellipsoid in 24 x 12 faces: less 2 %.
    const Emitter ellipse = emitterOf(DiskShape{1}, stretched(2, 0.5, 1));
    EXPECT_EQ(ellipse.kind, Emitter::Kind::polygons);
    EXPECT_NEAR(ellipse.area, kPi, 0.002 * kPi);
    const Emitter spheroid = emitterOf(SphereShape{1}, stretched(1, 1, 2)); // prolate, e^2 = 3/4
    const double e = std::sqrt(0.75);
    const double area = 2 * kPi * (1 + 2 / e * std::asin(e));
    EXPECT_EQ(spheroid.kind, Emitter::Kind::polygons);
    EXPECT_NEAR(spheroid.area, area, 0.02 * area);
}

TEST(LightShapes, HaveTheExitanceOfALambertianLight) {
    const Rgb exitance = emitterOf(RectShape{}).exitance; // pi L
    EXPECT_FLOAT_EQ(exitance.r, float(kPi));
    EXPECT_FLOAT_EQ(exitance.g, float(2 * kPi));
    EXPECT_FLOAT_EQ(exitance.b, float(3 * kPi));
}

TEST(LightShapes, ShineAlongMinusZInAnyFrameMirroredOnesIncluded) {
    const glm::dmat4 turned =
        moved(1, 2, 3) * glm::rotate(glm::dmat4(1.0), 0.5, glm::dvec3(1, 0, 0));
    for (const glm::dmat4& frame :
         {glm::dmat4(1.0), turned, turned * stretched(-1, 1, 1), turned * stretched(1, 1, -1)}) {
        const glm::vec3 centre(frame[3]);
        const glm::vec3 forward = glm::normalize(-glm::vec3(frame[2]));
        const glm::vec3 before = centre + forward, behind = centre - forward;
        const Emitter rect = emitterOf(RectShape{}, frame);
        EXPECT_GT(polygonFormFactor(before, -forward, rect.polygons[0]), 0);
        EXPECT_EQ(polygonFormFactor(behind, forward, rect.polygons[0]), 0);
        const Emitter disk = emitterOf(DiskShape{}, frame);
        EXPECT_GT(glm::dot(disk.axis, forward), 0.999f);
    }
}

TEST(LightShapes, AreMeshesThatFaceWhereTheyShine) {
    for (const LightShape& shape : {LightShape(RectShape{}), LightShape(DiskShape{})}) {
        const MeshData mesh = lightShapeMesh(Light("lamp", shape, Rgb(1.0f)));
        std::vector<glm::vec3> outline;
        for (std::int32_t i : mesh.faceVertexIndices)
            outline.push_back(mesh.points[std::size_t(i)]);
        EXPECT_GT(polygonFormFactor({0, 0, -1}, {0, 0, 1}, outline), 0);
        EXPECT_EQ(mesh.materials[0]->reflectance(), Rgb());
        EXPECT_EQ(mesh.materials[0]->emission(), Rgb(1.0f));
    }
    const MeshData sphere = lightShapeMesh(Light("lamp", SphereShape{1}, Rgb(1.0f)));
    std::size_t first = 0;
    for (std::int32_t count : sphere.faceVertexCounts) {
        const auto at = [&](std::size_t k) {
            return sphere.points[std::size_t(sphere.faceVertexIndices[first + k])];
        };
        EXPECT_GT(glm::dot(glm::cross(at(1) - at(0), at(2) - at(0)), at(0)), 0);
        first += std::size_t(count);
    }
}

/// The emissive faces of a mesh, patches being 0.4 m.
std::vector<FaceEmitter> emittersOf(const MeshData& data) {
    const SurfaceMesh mesh = placeSurface(data, glm::dmat4(1.0));
    return faceEmitters(mesh, {}, 0.4f);
}

TEST(FaceEmitters, AreAsManyAsTheirAreaAsksForWhateverTheMesh) {
    // Within .8 m all send as one. A sixteenth of 28 m^2 is a square of 1.33 m: a flat piece whose
    // diagonal is between that and half of it has .22 to .88 m^2.
    for (const int rings : {6, 24, 96}) {
        EXPECT_EQ(emittersOf(ballData(rings, 0.05f, paint(Rgb(0.5f), Rgb(100)))).size(), 1u);
        const auto large = emittersOf(ballData(rings, 1.5f, paint(Rgb(0.5f), Rgb(100))));
        EXPECT_NEAR(double(large.size()), 70, 38) << rings;
    }
}

TEST(FaceEmitters, OfAGlobeLookAboutOneWayEach) {
    for (const int rings : {6, 24, 96}) {
        const auto globe = emittersOf(ballData(rings, 0.2f, paint(Rgb(0.5f), Rgb(100))));
        EXPECT_EQ(globe.size(), 4u);
        for (const FaceEmitter& faces : globe) {
            glm::dvec3 sum(0);
            for (const auto& polygon : faces.emitter.polygons) sum += areaVector(polygon);
            EXPECT_GT(glm::length(sum), 0.6 * faces.emitter.area) << rings;
        }
    }
    const MeshData panel = boxData({0, 0, 0}, {0.5f, 0.5f, 0.05f}, false, paint({}, Rgb(100)));
    EXPECT_EQ(emittersOf(panel).size(), 2u) << "its rim goes with either";
}

TEST(FaceEmitters, HaveAllOfTheAreaWhateverTheOrderOfTheFaces) {
    const MeshData ball = ballData(24, 0.6f, paint(Rgb(0.5f), Rgb(100)));
    MeshData mixed = ball;
    const std::size_t faces = ball.faceVertexCounts.size();
    for (std::size_t f = 0; f < faces; ++f)
        for (std::size_t k = 0; k < 3; ++k)
            mixed.faceVertexIndices[3 * f + k] = ball.faceVertexIndices[3 * (f * 997 % faces) + k];
    const auto area = [](const std::vector<FaceEmitter>& emitters) {
        double sum = 0;
        for (const FaceEmitter& faces : emitters) sum += faces.emitter.area;
        return sum;
    };
    EXPECT_NEAR(area(emittersOf(mixed)), area(emittersOf(ball)), 1e-6);
    EXPECT_EQ(emittersOf(mixed).size(), emittersOf(ball).size());
}

TEST(FaceEmitters, LeaveABulbWhole) {
    // Twelve bulbs around a chandelier of 1.2 m.
    MeshData bulbs;
    for (int b = 0; b < 12; ++b) {
        const MeshData bulb = ballData(6, 0.03f, paint(Rgb(0.5f), Rgb(100)));
        const int first = int(bulbs.points.size());
        const glm::vec3 at(0.6 * std::cos(b * kPi / 6), 0.6 * std::sin(b * kPi / 6), 0);
        for (const glm::vec3 point : bulb.points) bulbs.points.push_back(point + at);
        for (const int i : bulb.faceVertexIndices) bulbs.faceVertexIndices.push_back(first + i);
        bulbs.faceVertexCounts.insert(bulbs.faceVertexCounts.end(), bulb.faceVertexCounts.begin(),
                                      bulb.faceVertexCounts.end());
        bulbs.materials = bulb.materials;
    }
    const double whole =
        emittersOf(ballData(6, 0.03f, paint(Rgb(0.5f), Rgb(100)))).at(0).emitter.area;
    for (const FaceEmitter& faces : emittersOf(bulbs)) {
        const double count = faces.emitter.area / whole;
        EXPECT_NEAR(count, std::round(count), 1e-3) << "bulbs";
        EXPECT_LE(boundsOf(faces.emitter).diagonal(), 0.8f);
    }
}

TEST(PolygonArea, IsExactForAnyPlanarPolygon) {
    EXPECT_DOUBLE_EQ(polygonArea(std::vector<glm::vec3>{{0, 0, 1}, {2, 0, 1}, {0, 3, 1}}), 3);
    EXPECT_DOUBLE_EQ(polygonArea(std::vector<glm::vec3>{
                         {0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}}),
                     5);
}

} // namespace

} // namespace penumbra
