// Surfaces in cells and facets: no cracks, the right area, the right limit.
#include "radiosity/surface/Tessellation.h"
#include "radiosity/surface/EdgeRates.h"
#include "tests/support/Scenes.h"

#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <tuple>

namespace penumbra {

namespace {

using Place = std::tuple<float, float, float>;

Tessellation cut(const MeshData& data, float patchSize, float elementSize) {
    bool understood = false;
    Tessellation result =
        tessellate(placeSurface(data, glm::dmat4(1.0)), patchSize, elementSize, understood);
    EXPECT_TRUE(understood);
    return result;
}

std::size_t cornersOf(const Facet& facet) {
    return facet.vertices[2] == facet.vertices[3] ? 3 : 4;
}

/// Edges that are not gone along once each way, given by the positions of their ends.
int cracks(const Tessellation& t) {
    std::map<std::pair<Place, Place>, int> edges;
    const auto place = [&](std::uint32_t v) {
        const glm::vec3 p = t.vertices[v].position + glm::vec3(0); // -0 is 0
        return Place(p.x, p.y, p.z);
    };
    for (const Facet& facet : t.facets)
        for (std::size_t k = 0, n = cornersOf(facet); k < n; ++k) {
            const Place a = place(facet.vertices[k]), b = place(facet.vertices[(k + 1) % n]);
            if (a < b)
                edges[{a, b}] += 1;
            else
                edges[{b, a}] += 1000;
        }
    int count = 0;
    for (const auto& [edge, uses] : edges) count += uses != 1001;
    return count;
}

double areaOf(const Tessellation& t) {
    double area = 0;
    for (const Facet& facet : t.facets) {
        const auto at = [&](std::size_t k) {
            return glm::dvec3(t.vertices[facet.vertices[k]].position);
        };
        area += 0.5 * glm::length(glm::cross(at(2) - at(0), at(3) - at(1)));
    }
    return area;
}

MeshData meshOf(std::vector<glm::vec3> points, std::vector<std::vector<int>> faces) {
    MeshData data;
    data.points = std::move(points);
    for (const auto& face : faces) {
        data.faceVertexCounts.push_back(std::int32_t(face.size()));
        data.faceVertexIndices.insert(data.faceVertexIndices.end(), face.begin(), face.end());
    }
    data.materials = {paint(Rgb(0.5f))};
    return data;
}

/// An L of 2 x 2 x 1 m with a square of 1 m missing, its ends concave hexagons: area 14.
MeshData lBlock() {
    return meshOf({{0, 0, 0},
                   {2, 0, 0},
                   {2, 1, 0},
                   {1, 1, 0},
                   {1, 2, 0},
                   {0, 2, 0},
                   {0, 0, 1},
                   {2, 0, 1},
                   {2, 1, 1},
                   {1, 1, 1},
                   {1, 2, 1},
                   {0, 2, 1}},
                  {{5, 4, 3, 2, 1, 0},
                   {6, 7, 8, 9, 10, 11},
                   {0, 1, 7, 6},
                   {1, 2, 8, 7},
                   {2, 3, 9, 8},
                   {3, 4, 10, 9},
                   {4, 5, 11, 10},
                   {5, 0, 6, 11}});
}

/// A prism over a pentagon, one of its sides in two triangles.
MeshData pentagonPrism() {
    std::vector<glm::vec3> points;
    for (int i = 0; i < 10; ++i) {
        const double angle = 2 * 3.14159265358979 * (i % 5) / 5;
        points.emplace_back(std::cos(angle), std::sin(angle), i / 5);
    }
    return meshOf(points, {{4, 3, 2, 1, 0},
                           {5, 6, 7, 8, 9},
                           {0, 1, 6},
                           {0, 6, 5},
                           {1, 2, 7, 6},
                           {2, 3, 8, 7},
                           {3, 4, 9, 8},
                           {4, 0, 5, 9}});
}

MeshData cubeCage() {
    MeshData cage = boxData({-1, -1, -1}, {1, 1, 1}, false);
    cage.scheme = SubdivisionScheme::catmullClark;
    return cage;
}

/// The cage with the four edges around its top sharpened.
MeshData creasedCage(float sharpness) {
    MeshData cage = cubeCage();
    cage.creases = {{{4, 5, 7, 6, 4}, sharpness}};
    return cage;
}

class TessellationSizes : public testing::TestWithParam<std::pair<float, float>> {};

TEST_P(TessellationSizes, LeaveNoCracksInAnyClosedSurface) {
    const auto [patchSize, elementSize] = GetParam();
    MeshData prismCage = pentagonPrism();
    prismCage.scheme = SubdivisionScheme::catmullClark;
    MeshData corner = cubeCage();
    corner.corners = {{7, 10}};
    const std::map<std::string, MeshData> surfaces{
        {"box", boxData({0, 0, 0}, {2, 1, 0.3f}, false)},
        {"L", lBlock()},
        {"pentagonal prism", pentagonPrism()},
        {"Catmull-Clark cube", cubeCage()},
        {"Catmull-Clark cube, sharp crease", creasedCage(10)},
        {"Catmull-Clark cube, soft crease", creasedCage(1.5f)},
        {"Catmull-Clark cube, sharp corner", corner},
        {"Catmull-Clark prism", prismCage}};
    for (const auto& [name, data] : surfaces)
        EXPECT_EQ(cracks(cut(data, patchSize, elementSize)), 0) << name;
}

TEST_P(TessellationSizes, KeepTheAreaOfPolygons) {
    const auto [patchSize, elementSize] = GetParam();
    EXPECT_NEAR(areaOf(cut(boxData({0, 0, 0}, {2, 1, 0.3f}, false), patchSize, elementSize)), 5.8,
                1e-4);
    EXPECT_NEAR(areaOf(cut(lBlock(), patchSize, elementSize)), 14, 1e-4);
    // 2 pentagons of 5/2 sin 72 and 5 sides of 2 sin 36.
    EXPECT_NEAR(areaOf(cut(pentagonPrism(), patchSize, elementSize)), 10.633135104, 1e-4);
}

TEST_P(TessellationSizes, AreKeptByElementsWithinAThird) {
    // Rates are whole numbers an edge, and inner rows stretch a little: but no facet is far larger
    // than was asked for.
    const auto [patchSize, elementSize] = GetParam();
    for (const MeshData& data : {boxData({0, 0, 0}, {2, 1, 0.3f}, false), cubeCage()}) {
        const Tessellation t = cut(data, patchSize, elementSize);
        for (const Facet& facet : t.facets)
            for (std::size_t k = 0, n = cornersOf(facet); k < n; ++k)
                EXPECT_LE(glm::distance(t.vertices[facet.vertices[k]].position,
                                        t.vertices[facet.vertices[(k + 1) % n]].position),
                          1.34f * elementSize);
    }
}

INSTANTIATE_TEST_SUITE_P(Sizes, TessellationSizes,
                         testing::Values(std::pair(5.0f, 5.0f), std::pair(1.0f, 0.4f),
                                         std::pair(0.37f, 0.11f), std::pair(0.2f, 0.2f)));

TEST(Tessellation, OfACatmullClarkCubeHasTheKnownLimitPositions) {
    // Halstead, Kass & DeRose 1993: (n^2 v + 4 sum e + sum f)/(n (n + 5)). Corners of a cube of
    // half-size 1: n = 3, (9 + 4 - 1)/24 = 1/2. Middles of faces, one step on: n = 4,
    // (16 + 12 + 20/9)/36 = 0.839506.
    const Tessellation t = cut(cubeCage(), 0.5f, 0.1f);
    float toCorner = 1e30f, toMiddle = 1e30f;
    for (const SurfacePoint& vertex : t.vertices) {
        toCorner = std::min(toCorner, glm::distance(vertex.position, glm::vec3(0.5f)));
        toMiddle = std::min(toMiddle, glm::distance(vertex.position, {0, 0, 0.839506f}));
    }
    EXPECT_LT(toCorner, 1e-5f);
    EXPECT_LT(toMiddle, 1e-5f);
}

TEST(Tessellation, OfACageWithAllEdgesSharpIsTheCageItself) {
    MeshData cage = cubeCage();
    for (const auto& face : kBoxFacesInwards)
        for (std::size_t k = 0; k < 4; ++k)
            cage.creases.push_back({{std::int32_t(face[k]), std::int32_t(face[(k + 1) % 4])}, 10});
    EXPECT_NEAR(areaOf(cut(cage, 0.5f, 0.25f)), 24, 1e-4);
}

TEST(Tessellation, SharesVerticesWhereTheSurfaceIsSmoothOnly) {
    // A flat sheet in two faces is one grid; a box keeps three vertices at each corner.
    const MeshData sheet =
        meshOf({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}},
               {{0, 1, 4, 3}, {1, 2, 5, 4}});
    EXPECT_EQ(cut(sheet, 1, 0.5f).vertices.size(), 5u * 3);
    EXPECT_EQ(cut(boxData({0, 0, 0}, {1, 1, 1}, false), 1, 1).vertices.size(), 24u);
    const Tessellation smooth = cut(cubeCage(), 1, 0.2f);
    std::set<Place> places;
    for (const SurfacePoint& vertex : smooth.vertices)
        places.emplace(vertex.position.x, vertex.position.y, vertex.position.z);
    EXPECT_EQ(smooth.vertices.size(), places.size());
}

TEST(Tessellation, PutsEachFacetIntoTheCellThatItLiesIn) {
    const Tessellation t = cut(floorData(0, 2, 0, 1, 0), 0.5f, 0.25f);
    ASSERT_EQ(t.cells.size(), 8u);
    EXPECT_EQ(t.facets.size(), 32u);
    for (const Facet& facet : t.facets) {
        const auto* const q = t.outline.data() + t.cells[facet.cell].firstCorner;
        for (std::size_t k = 0; k < 4; ++k) {
            const glm::vec2 st = facet.st[k];
            const glm::vec3 p =
                glm::mix(glm::mix(q[0], q[1], st.x), glm::mix(q[3], q[2], st.x), st.y);
            EXPECT_LT(glm::distance(p, t.vertices[facet.vertices[k]].position), 1e-5f);
        }
    }
}

TEST(Tessellation, CutsNoEdgeIntoMorePartsThanBfrCan) {
    // A kerb of 8 km by 10 cm in elements of 10 cm; Bfr's rates end at 32,767.
    const Tessellation t = cut(floorData(0, 8000, 0, 0.1f, 0), 500, 0.1f);
    EXPECT_LE(t.facets.size(), 32767u);
    EXPECT_GE(t.facets.size(), 32000u);
    EXPECT_NEAR(areaOf(t), 800, 0.1);
}

/// A polygon of `area` [m^2], 2 m long, turned about an axis askew; it starts at the origin.
MeshData sliver(const std::vector<glm::vec2>& shape, float area, float angle) {
    double twice = 0;
    for (std::size_t i = 0; i < shape.size(); ++i) {
        const glm::vec2 a = shape[i], b = shape[(i + 1) % shape.size()];
        twice += double(a.x) * b.y - double(a.y) * b.x;
    }
    const auto turn = glm::angleAxis(angle, glm::normalize(glm::vec3(1, 2, 3)));
    std::vector<glm::vec3> points;
    for (glm::vec2 p : shape) points.push_back(turn * glm::vec3(p.x, p.y * 2 * area / twice, 0));
    return polygonData(points);
}

const std::map<std::string, std::vector<glm::vec2>> kSlivers{
    {"right triangle", {{0, 0}, {2, 0}, {2, 1}}},
    {"needle", {{0, 0}, {2, 0.5f}, {0, 1}}},
    {"flat triangle", {{0, 0}, {2, 0}, {1, 1}}},
    {"strip", {{0, 0}, {2, 0}, {2, 1}, {0, 1}}},
    {"sheared strip", {{0, 0}, {1, 0}, {2, 1}, {1, 1}}},
    {"kite", {{0, 0}, {1.5f, -0.5f}, {2, 0}, {1.5f, 0.5f}}},
    {"pentagon", {{0, 0}, {1, 0}, {2, 0.5f}, {1, 1}, {0, 1}}},
    {"octagon",
     {{0, 0.3f}, {0.3f, 0}, {1.7f, 0}, {2, 0.3f}, {2, 0.7f}, {1.7f, 1}, {0.3f, 1}, {0, 0.7f}}}};

TEST(Tessellation, MakesNoMorePiecesThanTheAreaHoldsHoweverThinTheShape) {
    // Of any shape as many as of a square of the same area (1024), within some times. The long
    // edges of a triangle of 2 m by 10 micrometres would be cut into 20,000 elements each.
    for (const auto& [name, shape] : kSlivers)
        for (SubdivisionScheme scheme : {SubdivisionScheme::none, SubdivisionScheme::catmullClark})
            for (float width : {2.0f, 0.1f, 1e-2f, 1e-3f, 1e-5f})
                for (float angle : {0.0f, 0.4f, 2.0f}) {
                    const float area = width; // half or all of 2 m by `width`
                    MeshData data = sliver(shape, area, angle);
                    data.scheme = scheme;
                    const float patchSize = std::sqrt(area / 64), elementSize = patchSize / 4;
                    const Tessellation t = cut(data, patchSize, elementSize);
                    const double times = 6 * std::max(1.0, double(shape.size()) / 4);
                    const double some = double(shape.size()) + 64;
                    const std::string where = name + ", " + std::to_string(width);
                    EXPECT_GT(t.facets.size(), 0u) << where;
                    EXPECT_LE(double(t.cells.size()), times * 64 + some) << where;
                    EXPECT_LE(double(t.facets.size()), times * 1024 + some) << where;
                    if (scheme == SubdivisionScheme::none && width > 1e-4f) { // floats end there
                        EXPECT_NEAR(areaOf(t), area, 0.02 * area) << where;
                    }
                }
}

/// A sheet in narrow pleats, in 199 triangles of 1 to 2 m by some 7 cm that meet at one point:
/// area 9.1 m^2.
MeshData fan() {
    std::vector<glm::vec3> points{{0, 0, 1}};
    std::vector<std::vector<int>> faces;
    for (int i = 0; i < 200; ++i) {
        points.emplace_back(1, 0.01 * i, 1 + 0.1 * std::sin(i));
        if (i > 0) faces.push_back({0, i, i + 1});
    }
    return meshOf(points, faces);
}

TEST(Tessellation, CutsNeedlesIntoStripsAndNoMorePiecesThanTheirAreaHolds) {
    // With a grid at each corner of each triangle it was 10,179 cells and 461,584 facets, most of
    // them slivers themselves. As many as squares of the same area hold are 1,500 and 96,000.
    const float patchSize = 0.078f, elementSize = patchSize / 8;
    MeshData data = fan();
    for (SubdivisionScheme scheme : {SubdivisionScheme::none, SubdivisionScheme::catmullClark}) {
        data.scheme = scheme; // OpenSubdiv refuses it: too many faces at one point
        bool understood = false;
        const Tessellation t =
            tessellate(placeSurface(data, glm::dmat4(1.0)), patchSize, elementSize, understood);
        EXPECT_FALSE(t.smooth);
        const double area = areaOf(t), some = 199;
        EXPECT_NEAR(area, 9.0976, 1e-3);
        EXPECT_LE(double(t.cells.size()), area / (patchSize * patchSize) + 8 * some);
        EXPECT_LE(double(t.facets.size()), area / (elementSize * elementSize) + 2 * 68 * some);
        EXPECT_GE(double(t.facets.size()), area / (elementSize * elementSize) / 2);
    }
}

TEST(Tessellation, CutsNeedlesThatAreNarrowerThanAnElementAlongOnly) {
    // A disk of ten thousand triangles, .5 m by .3 mm: each had 56 pieces.
    const int count = 10'000;
    std::vector<glm::vec3> points{{0, 0, 0}};
    std::vector<std::vector<int>> faces;
    for (int i = 0; i < count; ++i) {
        const double angle = 2 * 3.14159265358979 * i / count;
        points.emplace_back(0.5 * std::cos(angle), 0.5 * std::sin(angle), 0);
        faces.push_back({0, i + 1, (i + 1) % count + 1});
    }
    const Tessellation t = cut(meshOf(points, faces), 0.4f, 0.1f);
    EXPECT_EQ(t.facets.size(), 6u * count);
    EXPECT_EQ(cracks(t), count) << "the rim";
}

TEST(Tessellation, LeavesNoCracksBetweenNeedles) {
    // A spire of 2 m over a dodecagon of 10 cm.
    std::vector<glm::vec3> points{{0, 0, 2}};
    std::vector<std::vector<int>> faces(1);
    for (int i = 0; i < 12; ++i) {
        const double angle = i * 3.14159265358979 / 6;
        points.emplace_back(0.1 * std::cos(angle), 0.1 * std::sin(angle), 0);
        faces.push_back({0, i + 1, (i + 1) % 12 + 1});
        faces[0].insert(faces[0].begin(), i + 1); // from below
    }
    for (const auto& [patchSize, elementSize] : {std::pair(0.1f, 0.01f), std::pair(0.04f, 0.03f)}) {
        const Tessellation t = cut(meshOf(points, faces), patchSize, elementSize);
        EXPECT_EQ(cracks(t), 0);
        EXPECT_EQ(t.leftOut, 0u);
        // The base is 3 r^2, the sides are 12 times half of 2 r sin 15 by sqrt(4 + (r cos 15)^2).
        EXPECT_NEAR(areaOf(t), 0.03 + 12 * 0.1 * 0.2588190 * std::sqrt(4 + 0.00933013), 1e-5);
    }
}

/// A wedge of 2 m by 1 m, `thickness` at its thick end: two of its sides are slivers.
MeshData wedge(float thickness) {
    return meshOf(
        {{0, 0, 0}, {2, 0, 0}, {2, 0, thickness}, {0, 1, 0}, {2, 1, 0}, {2, 1, thickness}},
        {{0, 3, 4, 1}, {0, 2, 5, 3}, {1, 4, 5, 2}, {0, 1, 2}, {3, 5, 4}});
}

TEST(Tessellation, CutsAnEdgeBesideASliverAsItsLargeFaceWantsIt) {
    const MeshData data = wedge(1e-3f);
    for (SubdivisionScheme scheme : {SubdivisionScheme::none, SubdivisionScheme::bilinear}) {
        MeshData mesh = data;
        mesh.scheme = scheme;
        const Tessellation t = cut(mesh, 0.2f, 0.02f);
        EXPECT_EQ(cracks(t), 0);
        std::vector<std::size_t> facets(5);
        for (const Facet& facet : t.facets) ++facets[t.cells[facet.cell].face];
        EXPECT_EQ(facets[0], 5000u); // 100 by 50
        EXPECT_EQ(facets[1], 5000u);
        EXPECT_LE(facets[3], 400u); // the two edges of 100, and little inside; it was 7,500
    }
}

TEST(Tessellation, LeavesOrdinaryShapesAsFineAsTheyAreAskedFor) {
    // Two to one, three corners to twelve; a bench's side of 1.5 m by 3 cm.
    const std::vector<MeshData> ordinary{
        polygonData({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}}),
        polygonData({{0, 0, 0}, {1, 0, 0}, {0.5f, 0.87f, 0}}),
        polygonData({{0, 0, 0}, {1.5f, 0, 0}, {1.5f, 0.03f, 0}, {0, 0.03f, 0}}),
        polygonData({{0, 0.2f, 0},
                     {0.06f, 0.06f, 0},
                     {0.2f, 0, 0},
                     {1.8f, 0, 0},
                     {1.94f, 0.06f, 0},
                     {2, 0.2f, 0},
                     {2, 0.3f, 0},
                     {1.94f, 0.44f, 0},
                     {1.8f, 0.5f, 0},
                     {0.2f, 0.5f, 0},
                     {0.06f, 0.44f, 0},
                     {0, 0.3f, 0}})};
    for (const MeshData& data : ordinary) {
        const SurfaceMesh mesh = placeSurface(data, glm::dmat4(1.0));
        const LimitSurface surface(mesh);
        const EdgeRates rates(mesh, surface, 0.4f, 0.05f);
        const auto face = surface.face(0);
        for (int e = 0; e < face->size(); ++e) {
            const EdgeRate rate = rates.ofFace(0)[std::size_t(e)];
            EXPECT_LE(face->edgeLength(e), 0.401f * float(rate.patches)) << face->size();
            EXPECT_LE(face->edgeLength(e), 0.0501f * float(rate.elements)) << face->size();
        }
    }
}

TEST(Tessellation, HasUnitNormalsThatPointOutwards) {
    for (const MeshData& data : {boxData({-1, -1, -1}, {1, 1, 1}, false), cubeCage()})
        for (const SurfacePoint& vertex : cut(data, 0.5f, 0.2f).vertices) {
            EXPECT_NEAR(glm::length(vertex.normal), 1, 1e-5f);
            EXPECT_GT(glm::dot(vertex.normal, vertex.position), 0);
        }
}

/// A square prism about z whose sides have the normals of a cylinder.
MeshData roundPrism() {
    MeshData data = boxData({-1, -1, -1}, {1, 1, 1}, false);
    for (const std::int32_t i : data.faceVertexIndices) {
        const glm::vec3 p = data.points[std::size_t(i)];
        data.normals.push_back(glm::normalize(glm::vec3(p.x, p.y, 0)));
    }
    return data;
}

TEST(Tessellation, NormalsOfTheFileAreInterpolatedAndNeighboursShareVertices) {
    const MeshData data = roundPrism();
    const Tessellation t = cut(data, 0.5f, 0.2f);
    for (const SurfacePoint& vertex : t.vertices) {
        EXPECT_NEAR(glm::length(vertex.normal), 1, 1e-5f);
        const bool side = std::abs(vertex.position.z) < 0.99f;
        const glm::vec3 outwards(vertex.position.x, vertex.position.y, 0);
        // Linear between the corners and then unit: within some degrees of the cylinder's.
        if (side) EXPECT_GT(glm::dot(vertex.normal, glm::normalize(outwards)), 0.97f);
    }
    MeshData flat = data;
    flat.normals.clear();
    EXPECT_LT(t.vertices.size(), cut(flat, 0.5f, 0.2f).vertices.size());
    EXPECT_EQ(cracks(t), 0);
}

TEST(Tessellation, NormalsOfTheFileStayInTheHemisphereOfTheirFace) {
    // Level with the face, behind it, all of them behind it.
    const std::vector<std::vector<glm::vec3>> wild{
        {{1, 0, 0}, {1, 0, 0}, {1, 0, 0}, {1, 0, 0}},
        {{0, 0.6f, -0.8f}, {0, 0, 1}, {1, 0, 0}, {0, 0, -1}},
        {{0, 0.6f, -0.8f}, {0, 0, -1}, {0.6f, 0, -0.8f}, {0, 0, -1}}};
    for (const auto& normals : wild) {
        MeshData data = floorData(0, 1, 0, 1, 0);
        data.normals = normals;
        for (const SurfacePoint& vertex : cut(data, 0.5f, 0.1f).vertices) {
            EXPECT_GE(vertex.normal.z, 0.4999f);
            EXPECT_NEAR(glm::length(vertex.normal), 1, 1e-5f);
        }
    }
}

TEST(Tessellation, NormalsOfTheFileGoWithMirrorsAndScales) {
    MeshData data = roundPrism();
    glm::dmat4 wide(1.0);
    wide[0][0] = -4; // an ellipse, mirrored
    bool understood = false;
    const Tessellation t = tessellate(placeSurface(data, wide), 0.5f, 0.2f, understood);
    for (const SurfacePoint& vertex : t.vertices)
        if (std::abs(vertex.position.z) < 0.99f)
            EXPECT_GT(glm::dot(vertex.normal, vertex.position), 0);
    EXPECT_EQ(cracks(t), 0);
}

} // namespace

} // namespace penumbra
