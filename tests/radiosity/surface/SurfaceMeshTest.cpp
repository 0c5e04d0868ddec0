// Which faces are used, and which of their sides there are.
#include "radiosity/surface/SurfaceMesh.h"
#include "radiosity/surface/Triangulate.h"
#include "tests/support/Scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace penumbra {

namespace {

/// How many faces show which sides.
struct Sides {
    int front = 0, back = 0, solid = 0;
    friend bool operator==(const Sides&, const Sides&) = default;
};

Sides sidesOf(const MeshData& data, const std::vector<glm::vec3>& lights = {},
              const glm::dmat4& toWorld = glm::dmat4(1.0)) {
    SurfaceMesh mesh = placeSurface(data, toWorld);
    chooseSides(mesh, lights);
    Sides sides;
    for (const SurfaceFace& face : mesh.faces)
        sides.front += face.front, sides.back += face.back, sides.solid += face.solid;
    return sides;
}

MeshData box(bool inwards, bool doubleSided) {
    MeshData data = boxData({0, 0, 0}, {1, 1, 1}, inwards);
    data.doubleSided = doubleSided;
    return data;
}

const glm::vec3 kInside(0.4f, 0.5f, 0.6f), kOutside(3, 0.5f, 0.6f);

TEST(ChooseSides, OfAClosedBoxOnlyTheOutsideIsLit) {
    EXPECT_EQ(sidesOf(box(false, true), {kOutside}), (Sides{6, 0, 6}));
}

TEST(ChooseSides, OfAnInsideOutTwoSidedBoxOnlyTheBackIsLit) {
    EXPECT_EQ(sidesOf(box(true, true), {kOutside}), (Sides{0, 6, 6}));
}

TEST(ChooseSides, ATwoSidedBoxWithALightInsideIsLitOnBothSides) {
    EXPECT_EQ(sidesOf(box(false, true), {kOutside, kInside}), (Sides{6, 6, 0}));
    EXPECT_EQ(sidesOf(box(true, true), {kInside}), (Sides{6, 6, 0}));
}

TEST(ChooseSides, AOneSidedSurfaceIsLitOnItsFront) {
    EXPECT_EQ(sidesOf(box(false, false), {kOutside}), (Sides{6, 0, 6}));
    EXPECT_EQ(sidesOf(box(true, false), {kInside}), (Sides{6, 0, 0})); // a room
}

TEST(ChooseSides, AOneSidedBoxThatLooksInwardsIsLitOutsideWhenNoLightIsIn) {
    EXPECT_EQ(sidesOf(box(true, false), {kOutside}), (Sides{6, 6, 0}));
}

TEST(ChooseSides, AnOpenTwoSidedSheetIsLitOnBothSides) {
    MeshData sheet = floorData(0, 1, 0, 1, 0);
    EXPECT_EQ(sidesOf(sheet), (Sides{1, 0, 0}));
    sheet.doubleSided = true;
    EXPECT_EQ(sidesOf(sheet), (Sides{1, 1, 0}));
}

TEST(ChooseSides, ABoxThatMissesAFaceIsOpen) {
    MeshData data;
    addBox(data, {0, 0, 0}, {1, 1, 1}, false, {0, 1, 2, 3, 4});
    data.materials = {paint(Rgb(0.5f))};
    data.doubleSided = true;
    EXPECT_EQ(sidesOf(data), (Sides{5, 5, 0}));
}

/// A box without its bottom, between z = 0 and 1, on a plate of another mesh of the same object.
struct KeyOnPlate {
    SurfaceMesh key, plate;
    MeshData keyData, plateData;

    explicit KeyOnPlate(const MeshData& under, const std::vector<glm::vec3>& lights = {})
        : plateData(under) {
        addBox(keyData, {0, 0, 0}, {1, 1, 1}, false, {0, 1, 2, 3, 5});
        keyData.materials = {paint(Rgb(0.5f))};
        keyData.doubleSided = true;
        key = placeSurface(keyData, glm::dmat4(1.0));
        plate = placeSurface(plateData, glm::dmat4(1.0));
        chooseSides(key, lights, std::array<const SurfaceMesh*, 2>{&key, &plate});
    }
    int solidFaces() const {
        return int(std::count_if(key.faces.begin(), key.faces.end(), [](const SurfaceFace& face) {
            return face.solid && face.front && !face.back;
        }));
    }
};

TEST(ChooseSides, ABoxThatStandsOpenOnAFaceOfItsObjectIsClosed) {
    EXPECT_EQ(KeyOnPlate(floorData(-1, 2, -1, 2, 0)).solidFaces(), 5);
    EXPECT_EQ(KeyOnPlate(floorData(0, 1, 0, 1, 0)).solidFaces(), 5);
}

TEST(ChooseSides, ABoxThatItsObjectClosesInPartIsOpen) {
    EXPECT_EQ(KeyOnPlate(floorData(0.1f, 2, -1, 2, 0)).solidFaces(), 0);   // too small
    EXPECT_EQ(KeyOnPlate(floorData(-1, 2, -1, 2, -0.1f)).solidFaces(), 0); // below
    EXPECT_EQ(KeyOnPlate(floorData(-1, 2, -1, 2, 1)).solidFaces(), 0);     // at the other end
}

TEST(ChooseSides, ALightUnderABoxKeepsItsInsideLit) {
    EXPECT_EQ(KeyOnPlate(floorData(-1, 2, -1, 2, 0), {kInside}).solidFaces(), 0);
    EXPECT_EQ(KeyOnPlate(floorData(-1, 2, -1, 2, 0), {kOutside}).solidFaces(), 5);
}

TEST(ChooseSides, ASheetOnAFaceOfItsObjectStaysASheet) {
    MeshData sheet = floorData(0, 1, 0, 1, 0);
    sheet.doubleSided = true;
    SurfaceMesh mesh = placeSurface(sheet, glm::dmat4(1.0));
    const MeshData under = floorData(-1, 2, -1, 2, 0);
    const SurfaceMesh plate = placeSurface(under, glm::dmat4(1.0));
    chooseSides(mesh, {}, std::array<const SurfaceMesh*, 1>{&plate});
    EXPECT_TRUE(mesh.faces[0].front && mesh.faces[0].back && !mesh.faces[0].solid);
}

TEST(ChooseSides, JudgesEachConnectedPartOfAMesh) {
    // A closed box beside a sheet, in one mesh.
    MeshData data = box(false, true);
    for (glm::vec3 p : {glm::vec3(5, 0, 0), glm::vec3(6, 0, 0), glm::vec3(6, 1, 0)})
        data.points.push_back(p);
    data.faceVertexCounts.push_back(3);
    for (int i : {8, 9, 10}) data.faceVertexIndices.push_back(i);
    EXPECT_EQ(sidesOf(data), (Sides{7, 1, 6}));
}

TEST(ChooseSides, SeesThatRepeatedPointsAreOne) {
    // Every face with corners of its own, as many files have it: still closed.
    const MeshData whole = box(false, true);
    MeshData split = whole;
    split.points.clear();
    for (std::size_t i = 0; i < whole.faceVertexIndices.size(); ++i) {
        split.points.push_back(whole.points[std::size_t(whole.faceVertexIndices[i])]);
        split.faceVertexIndices[i] = std::int32_t(i);
    }
    EXPECT_EQ(sidesOf(split), (Sides{6, 0, 6}));
}

TEST(PlaceSurface, KeepsFrontsFrontsInAMirror) {
    const glm::dmat4 mirror = glm::scale(glm::dmat4(1.0), glm::dvec3(-1, 1, 1));
    const SurfaceMesh mesh = placeSurface(box(false, false), mirror);
    for (const SurfaceFace& face : mesh.faces) {
        const auto corners = mesh.cornersOf(face);
        const glm::dvec3 outwards =
            glm::dvec3(mesh.points[corners[0]]) - glm::dvec3(-0.5, 0.5, 0.5);
        EXPECT_GT(glm::dot(newellNormal(mesh.points, corners), outwards), 0);
    }
}

TEST(PlaceSurface, LeavesOutFacesWithoutAreaAndCountsThem) {
    MeshData data = floorData(0, 1, 0, 1, 0);
    data.faceVertexCounts.push_back(3);
    for (int i : {0, 1, 1}) data.faceVertexIndices.push_back(i); // a line
    data.faceVertexCounts.push_back(3);
    for (int i : {2, 2, 2}) data.faceVertexIndices.push_back(i); // a point
    const SurfaceMesh mesh = placeSurface(data, glm::dmat4(1.0));
    EXPECT_EQ(mesh.faces.size(), 1u);
    EXPECT_EQ(mesh.used, 1u);
    EXPECT_EQ(mesh.skipped, 2u);
}

TEST(PlaceSurface, CutsConcaveFacesIntoConvexOnesOfTheSameFace) {
    const SurfaceMesh mesh = placeSurface(
        polygonData({{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}}),
        glm::dmat4(1.0));
    EXPECT_EQ(mesh.faces.size(), 2u); // four triangles, joined again in pairs
    double area = 0;
    for (const SurfaceFace& face : mesh.faces) {
        EXPECT_EQ(face.source, 0u);
        EXPECT_TRUE(isConvex(mesh.points, mesh.cornersOf(face)));
        area += 0.5 * glm::length(newellNormal(mesh.points, mesh.cornersOf(face)));
    }
    EXPECT_DOUBLE_EQ(area, 5);
}

TEST(PlaceSurface, LeavesOutAFaceOfTooManyCorners) {
    // Cutting is quadratic: a face of a million corners must not stop the program for an hour.
    std::vector<glm::vec3> points;
    for (int i = 0; i < 1000000; ++i)
        points.emplace_back(std::cos(i * 6.2831853e-6), std::sin(i * 6.2831853e-6), 0);
    const MeshData data = polygonData(std::move(points));
    EXPECT_EQ(placeSurface(data, glm::dmat4(1.0)).skipped, 1u);
}

TEST(NewellNormal, IsTwiceTheAreaAlsoForATwistedQuadrilateral) {
    const std::vector<glm::vec3> points{{0, 0, 0}, {1, 0, 1}, {1, 1, 0}, {0, 1, 1}};
    const glm::dvec3 normal = newellNormal(points, std::array<std::uint32_t, 4>{0, 1, 2, 3});
    EXPECT_NEAR(glm::distance(normal, glm::dvec3(0, 0, 2)), 0, 1e-12);
}

} // namespace

} // namespace penumbra
