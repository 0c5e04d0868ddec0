#include "viewer/overlay/MeshLines.h"

#include "tests/viewer/gl/LitScenes.h"

#include <algorithm>
#include <array>
#include <set>

namespace penumbra {

namespace {

/// 2 x 2 unit squares in two triangles each, around (1, 1, 0); each with corners of its own.
LitMeshData fourSquares() {
    LitMeshData data;
    for (int i = 0; i < 4; ++i) {
        const auto x = float(i % 2), y = float(i / 2);
        const auto first = std::uint32_t(4 * i);
        for (const glm::vec3 p : {glm::vec3(x, y, 0), glm::vec3(x + 1, y, 0),
                                  glm::vec3(x + 1, y + 1, 0), glm::vec3(x, y + 1, 0)})
            data.positions.push_back(p);
        for (const std::uint32_t k : {0u, 1u, 2u, 0u, 2u, 3u}) data.indices.push_back(first + k);
        data.triangleMaterial.insert(data.triangleMaterial.end(), {0, 0});
    }
    return data;
}

using Segment = std::array<float, 4>; ///< x y x y

std::set<Segment> clustersOf(const LitMeshData& data, const std::vector<std::uint32_t>& lines) {
    std::set<Segment> places;
    for (std::size_t i = 0; i < lines.size(); i += 2) {
        const glm::vec3 a = data.positions[lines[i]], b = data.positions[lines[i + 1]];
        places.insert({a.x, a.y, b.x, b.y});
    }
    return places;
}

TEST(MeshLines, ElementsHaveTheirEdgesOnceAndNoDiagonals) {
    const LitMeshData data = fourSquares();
    const MeshLines lines = meshLines(data);
    EXPECT_TRUE(lines.patches.empty()) << "nobody knows of patches";
    EXPECT_EQ(lines.elements.size(), 2u * 12);
    for (const Segment& s : clustersOf(data, lines.elements))
        EXPECT_TRUE(s[0] == s[2] || s[1] == s[3]) << "no diagonal";
}

TEST(MeshLines, AnOutlineGoesAroundAPatchThoughItsElementsShareNoVertices) {
    LitMeshData data = fourSquares();
    data.trianglePatch.assign(8, 5);
    const MeshLines lines = meshLines(data);
    EXPECT_EQ(lines.elements.size(), 2u * 4);
    EXPECT_EQ(clustersOf(data, lines.patches), (std::set<Segment>{{0, 0, 1, 0},
                                                                  {1, 0, 2, 0},
                                                                  {0, 2, 1, 2},
                                                                  {1, 2, 2, 2},
                                                                  {0, 0, 0, 1},
                                                                  {0, 1, 0, 2},
                                                                  {2, 0, 2, 1},
                                                                  {2, 1, 2, 2}}));
}

TEST(MeshLines, WhereTwoPatchesMeetBothHaveTheirOutline) {
    LitMeshData data = fourSquares();
    data.trianglePatch = {1, 1, 1, 1, 2, 2, 2, 2}; // lower and upper half
    const MeshLines lines = meshLines(data);
    EXPECT_EQ(lines.elements.size(), 2u * 2);
    EXPECT_EQ(lines.patches.size(), 2u * 12);
    EXPECT_TRUE(clustersOf(data, lines.patches).contains({0, 1, 1, 1}));
}

TEST(MeshLines, ATriangleOfItsOwnIsAnElement) {
    LitMeshData data = litSquare();
    data.indices = {0, 1, 2};
    data.triangleMaterial = {0};
    EXPECT_EQ(meshLines(data).elements.size(), 6u);
}

} // namespace

} // namespace penumbra
