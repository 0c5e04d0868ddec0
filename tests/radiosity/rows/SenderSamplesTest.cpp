// Where senders are sampled: stratified, on the sender, each point for the same share of it.
#include "radiosity/rows/SenderSamples.h"
#include "radiosity/mesh/Emitters.h"
#include "tests/support/Scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

namespace penumbra {

namespace {

TEST(Sobol02, HasOnePointInEveryElementaryIntervalOfEachPrefix) {
    // The (0,2) property: 2^k points, cells of 2^-a by 2^-(k-a), one point each, for all a. It is
    // what stratifies both coordinates (a = 0, k) and the square (a = k/2).
    for (int k = 0; k <= 12; ++k)
        for (int a = 0; a <= k; ++a) {
            std::set<std::pair<int, int>> cells;
            for (std::uint32_t i = 0; i < 1u << k; ++i) {
                const glm::vec2 p = sobol02(i, std::size_t(1) << k);
                cells.emplace(int(std::ldexp(p.x, a)), int(std::ldexp(p.y, k - a)));
            }
            EXPECT_EQ(cells.size(), 1u << k) << "2^" << k << " points, columns 2^" << a;
        }
}

TEST(Sobol02, StaysInTheOpenSquare) {
    for (std::uint32_t i = 0; i < 4096; ++i) {
        const glm::vec2 p = sobol02(i, 4096);
        EXPECT_TRUE(p.x > 0 && p.x < 1 && p.y > 0 && p.y < 1) << i;
    }
}

TEST(SquareToDisk, KeepsAreas) {
    // A share q of the square goes to a share q of the disk: rings of equal area get equal counts.
    constexpr int kGrid = 200, kRings = 5;
    std::array<int, kRings> count{};
    for (int i = 0; i < kGrid; ++i)
        for (int j = 0; j < kGrid; ++j) {
            const glm::vec2 p =
                squareToDisk({(float(i) + 0.5f) / kGrid, (float(j) + 0.5f) / kGrid});
            const float r2 = glm::dot(p, p);
            ASSERT_LE(r2, 1.00001f);
            ++count[std::size_t(std::min(int(r2 * kRings), kRings - 1))];
        }
    for (int n : count) EXPECT_NEAR(n, kGrid * kGrid / kRings, 0.01 * kGrid * kGrid);
}

Emitter polygonEmitter(std::vector<std::vector<glm::vec3>> polygons) {
    Emitter emitter;
    for (const auto& polygon : polygons) emitter.area += polygonArea(polygon);
    emitter.polygons = std::move(polygons);
    return emitter;
}

const std::vector<glm::vec3> kSquare{{0, 0, 1}, {0, 2, 1}, {2, 2, 1}, {2, 0, 1}}; // faces down

TEST(EmitterSamples, OfAParallelogramAreStratifiedOnIt) {
    const auto samples = sampleEmitter(polygonEmitter({kSquare}), 16);
    std::set<std::pair<int, int>> cells;
    for (const auto& point : samples.points) {
        EXPECT_EQ(point.position.z, 1);
        EXPECT_EQ(point.normal, glm::vec3(0, 0, -1));
        cells.emplace(int(point.position.x * 2), int(point.position.y * 2));
    }
    EXPECT_EQ(cells.size(), 16u);
}

TEST(EmitterSamples, FollowTheAreasOfTheirPolygons) {
    // Areas 4 and 12: of any 16 samples, 4 and 12.
    const std::vector<glm::vec3> wide{{10, 0, 1}, {10, 2, 1}, {16, 2, 1}, {16, 0, 1}};
    const auto samples = sampleEmitter(polygonEmitter({kSquare, wide}), 64);
    for (std::size_t first = 0; first < 64; first += 16) {
        int onWide = 0;
        for (std::size_t i = first; i < first + 16; ++i) onWide += samples.points[i].position.x > 5;
        EXPECT_EQ(onWide, 12);
    }
}

TEST(EmitterSamples, OfATriangleHaveItsCentroidForTheirMean) {
    const std::vector<glm::vec3> triangle{{0, 0, 0}, {3, 0, 0}, {0, 6, 3}};
    const auto samples = sampleEmitter(polygonEmitter({triangle}), 64);
    glm::vec3 mean(0);
    for (const auto& point : samples.points) {
        mean += point.position / 64.0f;
        EXPECT_NEAR(point.position.z, point.position.y / 2, 1e-5f); // in the plane
        EXPECT_LE(point.position.x / 3 + point.position.y / 6, 1.00001f);
    }
    EXPECT_LT(glm::distance(mean, {1, 2, 1}), 0.05f);
}

// Found by an animation that shrank a glowing box to where floats can't tell its corners apart.
TEST(EmitterSamples, OfWhatHasNoAreaLieOnItAndLookOneWay) {
    const glm::vec3 at{54, 1, 2};
    const std::vector<glm::vec3> square(4, at), triangle(3, at);
    using Polygons = std::vector<std::vector<glm::vec3>>;
    for (const Polygons& polygons :
         {Polygons{square}, Polygons{triangle}, Polygons{square, square}})
        for (const auto& sample : sampleEmitter(polygonEmitter(polygons), 16).points) {
            EXPECT_EQ(sample.position, at);
            EXPECT_EQ(glm::length(sample.normal), 1);
        }
}

TEST(EmitterSamples, OfADiskLieOnItEvenly) {
    Emitter disk;
    disk.kind = Emitter::Kind::disk;
    disk.centre = {1, 2, 3};
    disk.axis = glm::normalize(glm::vec3(1, -2, 0.5f));
    disk.radius = 0.5f;
    const auto samples = sampleEmitter(disk, 64);
    int inner = 0;
    for (const auto& point : samples.points) {
        const glm::vec3 d = point.position - disk.centre;
        EXPECT_NEAR(glm::dot(d, disk.axis), 0, 1e-6f);
        EXPECT_LE(glm::length(d), disk.radius * 1.00001f);
        EXPECT_EQ(point.normal, disk.axis);
        inner += glm::dot(d, d) < 0.5f * disk.radius * disk.radius;
    }
    EXPECT_NEAR(inner, 32, 4); // half of the area
}

TEST(PatchSamples, LieInFourQuartersOfThePatch) {
    const Scene scene = sceneOf({object("floor", floorData(0, 1, 0, 1, 0))});
    const BuiltPatches built = meshed(scene, {.patchSize = 1, .elementSize = 0.25f});
    ASSERT_EQ(built.patches.patches.size(), 1u);
    glm::vec3 points[kPatchSamples];
    samplePatch(built.patches, built.patches.patches[0], points);
    std::set<std::pair<int, int>> cells;
    for (std::size_t i = 0; i < kPatchSamples; ++i) {
        EXPECT_NEAR(points[i].z, 0, 1e-6f);
        cells.emplace(int(points[i].x * 4), int(points[i].y * 4));
        for (std::size_t j = i / 4 * 4; j < i; ++j) { // the same quarter
            EXPECT_EQ(points[i].x < 0.5f, points[j].x < 0.5f);
            EXPECT_EQ(points[i].y < 0.5f, points[j].y < 0.5f);
        }
    }
    EXPECT_EQ(cells.size(), kPatchSamples);
}

TEST(PatchSamples, OfACurvedPatchLieOnItsElements) {
    MeshData cage = boxData({-1, -1, -1}, {1, 1, 1}, false);
    cage.scheme = SubdivisionScheme::catmullClark;
    const BuiltPatches built = meshed(sceneOf({object("ball", std::move(cage))}),
                                      {.patchSize = 0.5f, .elementSize = 0.05f});
    float lowest = 1e30f;
    for (const Vertex& vertex : built.patches.vertices)
        lowest = std::min(lowest, glm::length(vertex.position));
    glm::vec3 points[kPatchSamples];
    for (const Patch& patch : built.patches.patches) {
        samplePatch(built.patches, patch, points);
        for (const glm::vec3& point : points) EXPECT_GT(glm::length(point), lowest - 2e-3f);
    }
}

TEST(Facing, IsTheProductOfTheHeightsButForReceiversInTheSendersPlane) {
    EXPECT_EQ(facing(0.5f, 0.25f, 4), 0.125f);
    EXPECT_EQ(facing(-0.5f, 0.25f, 4), 0);
    EXPECT_EQ(facing(0.5f, -0.25f, 4), 0);
    EXPECT_EQ(facing(0.5f, 6e-8f, 4), 0); // one rounding step of a coordinate
    EXPECT_EQ(facing(0.5f, 1e-4f, 4), 0.5f * 1e-4f);
}

} // namespace

} // namespace penumbra
