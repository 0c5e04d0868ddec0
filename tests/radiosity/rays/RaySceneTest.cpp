// Rays: what they meet, and whom they name.
#include "radiosity/rays/RayScene.h"

#include "base/Error.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace penumbra {

namespace {

/// A square of side 2 around (0, 0, z), front up.
RayMesh square(float z) {
    RayMesh mesh;
    mesh.vertices = {{-1, -1, z}, {1, -1, z}, {1, 1, z}, {-1, 1, z}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    mesh.solid = {0, 0};
    return mesh;
}

TEST(RayScene, NamesTheObjectThatBlocksEachSegment) {
    RayMesh aside = square(1);
    for (glm::vec3& p : aside.vertices) p.x += 10;
    const RayScene scene(std::array{square(1), RayMesh(), aside}); // an empty object keeps its id
    ShadowRays rays;
    rays.set(0, {0.1f, 0.2f, 0}, {0.1f, 0.2f, 2});
    rays.set(3, {10.1f, 0.2f, 2}, {10.1f, 0.2f, 0});
    rays.set(7, {5, 0, 0}, {5, 0, 2});
    scene.occluded(rays);
    EXPECT_EQ(rays.blocker[0], 0u);
    EXPECT_EQ(rays.blocker[3], 2u);
    EXPECT_EQ(rays.blocker[7], ObjectId::kNone);
    EXPECT_EQ(rays.blocker[1], ObjectId::kNone); // was not to be tested
}

TEST(RayScene, BlocksASegmentFromBothSidesOfASurface) {
    const RayScene scene(std::array{square(1)});
    EXPECT_TRUE(scene.occluded({0, 0.1f, 0}, {0, 0.1f, 2}));
    EXPECT_TRUE(scene.occluded({0, 0.1f, 2}, {0, 0.1f, 0}));
}

TEST(RayScene, OfEquallyNearTrianglesMeetsTheFirst) {
    const RayScene scene(std::array{square(1), square(0), square(0)});
    for (float x = -0.95f; x < 1; x += 0.1f) {
        const RayHit hit = scene.nearest({x, 0.3f, 0.5f}, {0, 0, -1}, 10);
        ASSERT_TRUE(hit.met());
        EXPECT_EQ(hit.object.value, 1u);
        // On the diagonal that both triangles share, too.
        EXPECT_EQ(scene.nearest({x, x, 0.5f}, {0, 0, -1}, 10).triangle, 0u);
    }
}

TEST(RayScene, RaysFromOnePointMeetTogetherWhatEachOneMeets) {
    std::array objects{square(1), square(0), square(-1)};
    objects[1].lit = {kBack, kNoSide}; // of its first half the back, of the other none
    const RayScene scene(objects);
    std::vector<glm::vec3> along;
    for (int i = 0; i < 13; ++i) along.emplace_back(0.05f * float(i) - 0.3f, 0.01f, i % 3 - 1);
    along[7] = glm::vec3(std::nanf(""), 0, 1);
    for (const auto faces : {RayScene::Faces::both, RayScene::Faces::front, RayScene::Faces::lit}) {
        std::vector<RayHit> hits(along.size());
        for (const float z : {0.5f, -0.5f}) {
            scene.nearest({0.2f, 0.1f, z}, along, 10, faces, hits);
            for (std::size_t i = 0; i < along.size(); ++i) {
                const RayHit one = scene.nearest({0.2f, 0.1f, z}, along[i], 10, faces);
                EXPECT_EQ(hits[i].object, one.object) << i;
                EXPECT_EQ(hits[i].triangle, one.triangle);
                EXPECT_EQ(hits[i].distance, one.distance);
                EXPECT_EQ(hits[i].back, one.back);
            }
        }
    }
    const auto below = [&](RayScene::Faces faces) {
        return scene.nearest({0.3f, -0.3f, -0.5f}, {0, 0, 1}, 10, faces).object.value;
    };
    EXPECT_EQ(below(RayScene::Faces::both), 1u);
    EXPECT_EQ(below(RayScene::Faces::lit), 1u);
    EXPECT_EQ(below(RayScene::Faces::front), ObjectId::kNone);
    EXPECT_EQ(scene.nearest({-0.3f, 0.3f, -0.5f}, {0, 0, 1}, 10, RayScene::Faces::lit).object.value,
              0u);
}

TEST(RayScene, OfTrianglesInOnePlaceMeetsThatOfTheLeastKey) {
    std::array objects{square(0), square(0), square(0)};
    objects[0].key = 3, objects[1].key = 1, objects[2].key = 2;
    const RayScene scene(objects);
    EXPECT_EQ(scene.nearest({0.1f, 0.3f, 1}, {0, 0, -1}, 10).object.value, 1u);
}

/// A cube of 2 m in many triangles, which share no vertex.
RayMesh cube(const glm::mat3& turn, glm::vec3 offset) {
    RayMesh mesh;
    for (const glm::vec3 normal : {glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, 1)})
        for (float side : {-1.0f, 1.0f}) {
            const glm::vec3 u(normal.z, normal.x, normal.y), v = side * glm::cross(normal, u);
            for (int j = 0; j < 4; ++j)
                for (int i = 0; i < 4; ++i) {
                    const auto first = std::uint32_t(mesh.vertices.size());
                    for (const auto& [k, l] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}})
                        mesh.vertices.push_back(offset + turn * (side * normal +
                                                                 (0.5f * float(i + k) - 1) * u +
                                                                 (0.5f * float(j + l) - 1) * v));
                    mesh.triangles.push_back({first, first + 1, first + 2});
                    mesh.triangles.push_back({first, first + 2, first + 3});
                }
        }
    return mesh;
}

TEST(RayScene, MeetsTheSameAtTheEdgesOfAnObjectThatWasMovedThereAndThatWasMadeThere) {
    // Cubes in many triangles, one turned there from elsewhere, with its hierarchy; rays towards
    // points of its edges, along planes that two faces share alike, and past its silhouette.
    const glm::mat3 turn(0, 1, 0, 0, 0, 1, 1, 0, 0);
    const glm::vec3 offset(0.3f, 0.7f, 0.1f);
    const RayMesh there = cube(turn, offset);
    const RayMesh wall = square(-3);
    const RayScene made(std::array{there, wall});
    RayScene moved(std::array{cube(glm::mat3(1), {-2, 0.5f, 3}), wall});
    moved.move({0}, there.vertices);
    moved.commit();
    int rays = 0;
    for (glm::vec3 eye : {offset + glm::vec3(2), offset + glm::vec3(1.0024f, 1.0024f, 3),
                          offset + glm::vec3(0, 1, 4), glm::vec3(0.1f, 0.2f, 4)})
        for (std::size_t v = 0; v < there.vertices.size(); ++v) {
            const std::size_t next = v % 4 == 3 ? v - 3 : v + 1; // along an edge of its square
            const glm::vec3 middle = 0.5f * (there.vertices[v] + there.vertices[next]);
            for (float along : {0.5f, 1.0f, 1.001f}) {
                const glm::vec3 to = glm::mix(offset + glm::vec3(1), middle, along);
                const RayHit one = made.nearest(eye, to - eye, 1e30f, RayScene::Faces::front);
                const RayHit other = moved.nearest(eye, to - eye, 1e30f, RayScene::Faces::front);
                EXPECT_EQ(one.met(), other.met());
                EXPECT_EQ(one.object, other.object);
                EXPECT_EQ(one.triangle, other.triangle);
                EXPECT_EQ(one.distance, other.distance);
                rays += one.met();
            }
        }
    EXPECT_GT(rays, 100);
}

TEST(RayScene, TracesNothingInLanesThatAreNotUsed) {
    // Embree is given rays from the origin up for these: they meet a corner there.
    const RayMesh mesh = cube(glm::mat3(1), {0, 0, 1.5f});
    const RayScene scene(std::array{mesh});
    ShadowRays rays;
    for (int i = 0; i < ShadowRays::kMost; ++i)
        rays.set(i, glm::vec3(1e30f), glm::vec3(std::nanf(""), 0, 0));
    rays.used = 0;
    rays.set(3, {-0.3f, -0.2f, 0}, {-0.3f, -0.2f, 1});
    scene.occluded(rays);
    for (int i = 0; i < ShadowRays::kMost; ++i)
        EXPECT_EQ(rays.blocker[i], i == 3 ? 0 : ObjectId::kNone) << i;
}

TEST(RayScene, SurvivesObjectsThatAreNoMoreThanAPoint) {
    // Embree divides what is there until boxes are small, and ends the program if they have no
    // size.
    std::vector<RayMesh> objects{square(1)};
    for (float size : {0.0f, 1e-45f, 1e-38f, 1e-20f})
        for (int i = 0; i < 10; ++i) {
            objects.push_back(square(0));
            for (glm::vec3& p : objects.back().vertices) p *= size;
        }
    RayScene scene(objects);
    EXPECT_TRUE(scene.nearest({0.1f, 0, 0}, {0, 0, 1}, 10).met());
    EXPECT_FALSE(scene.nearest({0.1f, 0, 0}, {0, 0, -1}, 10).met());
    for (const float size : {1.0f, 0.0f, 1.0f}) { // what shrinks to a point may grow again
        RayMesh moving = square(2);
        for (glm::vec3& p : moving.vertices) p *= size;
        for (std::uint32_t i = 1; i <= 20; ++i) scene.move({i}, moving.vertices);
        scene.commit();
        const RayHit hit = scene.nearest({0.1f, 0, 3}, {0, 0, -1}, 10);
        EXPECT_EQ(hit.object.value, size > 0 ? 1u : 0u);
        EXPECT_EQ(scene.nearest({0.3f, 0.5f, 1.5f}, {0, 0, 1}, 10).met(), size > 0);
    }
}

TEST(RayScene, SaysWhereSolidsThatMayHoldAPointEnd) {
    RayMesh tilted = square(0); // in a box of 1 m each way
    tilted.solid.assign(tilted.triangles.size(), 1);
    for (glm::vec3& p : tilted.vertices) p.z = p.x;
    RayScene scene(std::array{square(1), tilted});
    const glm::vec3 inside(0.1f, 0.2f, 0);
    const float end = scene.solidsEnd(inside, {0, 0, 2});
    const float top = tilted.vertices[0].z > 0 ? tilted.vertices[0].z : -tilted.vertices[0].z;
    EXPECT_NEAR(end, top / 2, 1e-3f) << "in lengths of the direction";
    EXPECT_GE(end, top / 2) << "beyond what is there";
    EXPECT_EQ(scene.solidsEnd({0, 0, 5}, {0, 0, -1}), 0) << "it holds no point out there";
    scene.show({1}, false);
    EXPECT_EQ(scene.solidsEnd(inside, {0, 0, 2}), 0) << "what is hidden is not there";
    scene.show({1}, true);
    for (glm::vec3& p : tilted.vertices) p.z += 5;
    scene.move({1}, tilted.vertices);
    EXPECT_EQ(scene.solidsEnd(inside, {0, 0, 2}), 0) << "it has been moved away";
    EXPECT_GT(scene.solidsEnd({0, 0, 5}, {0, 0, -1}), 0);
}

TEST(RayScene, FindsAllTrianglesUpToItsReach) {
    const RayScene scene(std::array{square(1), square(3)});
    EXPECT_EQ(scene.solidsEnd({0.1f, 0.2f, 1}, {0, 0, 1}), 0) << "nothing is solid";
    std::vector<RayHit> hits;
    for (const auto& [reach, count] :
         {std::pair(1.5f, 0u), std::pair(2.5f, 1u), std::pair(9.0f, 2u)}) {
        scene.all({0.1f, 0.2f, -1}, {0, 0, 1}, reach, hits);
        EXPECT_EQ(hits.size(), count) << reach;
    }
}

TEST(RayScene, MeetsNothingOnARayThatIsNoNumberOrOutOfRange) {
    const RayScene scene(std::array{square(1)});
    const float infinity = std::numeric_limits<float>::infinity();
    for (float nowhere : {3e38f, -infinity, std::nanf("")})
        for (int axis = 0; axis < 3; ++axis) {
            glm::vec3 bad(0.1f, 0.2f, 0);
            bad[axis] = nowhere;
            const glm::vec3 good(0.1f, 0.2f, 0), up(0, 0, 1);
            EXPECT_FALSE(scene.nearest(bad, up, 10).met());
            EXPECT_FALSE(scene.nearest(good, bad, 10).met());
            EXPECT_FALSE(scene.nearest(good, up, std::nanf("")).met());
            EXPECT_FALSE(scene.occluded(bad, good + 2.0f * up));
            EXPECT_FALSE(scene.occluded(good, bad));
            std::vector<RayHit> hits(1);
            scene.all(bad, up, 1, hits);
            EXPECT_TRUE(hits.empty());
            ShadowRays rays;
            rays.set(0, bad, good);
            rays.set(1, good, bad);
            rays.set(2, good, good + 2.0f * up); // its neighbours are no harm to it
            scene.occluded(rays);
            EXPECT_EQ(rays.blocker[0], ObjectId::kNone);
            EXPECT_EQ(rays.blocker[1], ObjectId::kNone);
            EXPECT_EQ(rays.blocker[2], 0u);
        }
}

TEST(RayScene, SaysWhatItCanNotTrace) {
    const float infinity = std::numeric_limits<float>::infinity();
    for (float nowhere : {1e30f, -1e13f, infinity, std::nanf("")}) {
        RayMesh mesh = square(1);
        RayScene scene(std::array{mesh});
        mesh.vertices[2].y = nowhere;
        EXPECT_THROW(RayScene(std::array{mesh}), Error) << nowhere;
        EXPECT_THROW(scene.move({0}, mesh.vertices), Error) << nowhere;
    }
}

TEST(RayScene, DoesNotTakeTheTargetForAnObstacle) {
    const RayScene scene(std::array{square(1)});
    EXPECT_FALSE(scene.occluded({0.3f, 0.1f, 0}, {0.3f, 0.1f, 1}));
}

TEST(RayScene, DoesNotTakeATargetAtAGrazingAngleForAnObstacle) {
    // A few millimetres apart and rising by a tenth: rounding must not end the segment early.
    const RayScene scene(std::array{square(1)});
    for (int i = 0; i < 1000; ++i) {
        const glm::vec3 target(-0.9f + 0.0018f * float(i), 0.0007f * float(i), 1);
        const glm::vec3 origin = target + glm::vec3(-0.004f, 0.001f, 0.0004f);
        EXPECT_FALSE(scene.occluded(origin, target)) << i;
    }
}

TEST(RayScene, FindsTheNearestTriangleAndWhereOnIt) {
    const RayScene scene(std::array{square(1), square(3)});
    const RayHit hit = scene.nearest({0.5f, -0.25f, 0}, {0, 0, 2}, 10);
    ASSERT_TRUE(hit.met());
    EXPECT_EQ(hit.object.value, 0u);
    EXPECT_EQ(hit.triangle, 0u);
    EXPECT_FLOAT_EQ(hit.distance, 0.5f);
    EXPECT_GT(hit.normal.z, 0);
    const auto& v = square(1).vertices;
    const glm::vec3 p = (1 - hit.u - hit.v) * v[0] + hit.u * v[1] + hit.v * v[2];
    EXPECT_LT(glm::distance(p, {0.5f, -0.25f, 1}), 1e-6f);
}

TEST(RayScene, LooksNoFurtherThanItsReach) {
    const RayScene scene(std::array{square(1)});
    EXPECT_FALSE(scene.nearest({0.1f, 0, 0}, {0, 0, 1}, 0.9f).met());
    EXPECT_TRUE(scene.nearest({0.1f, 0, 0}, {0, 0, 1}, 1.1f).met());
}

TEST(RayScene, PassesThroughBacksWhenFrontsAreWanted) {
    const RayScene scene(std::array{square(1), square(3)});
    EXPECT_FALSE(scene.nearest({0.1f, 0, 0}, {0, 0, 1}, 10, RayScene::Faces::front).met());
    const RayHit down = scene.nearest({0.1f, 0, 2}, {0, 0, -1}, 10, RayScene::Faces::front);
    EXPECT_EQ(down.object.value, 0u);
}

TEST(RayScene, LetsNoRayThroughTheSeamsOfASurface) {
    // A 16 x 16 grid in two triangles a cell, rays at every corner, edge and diagonal, straight and
    // slanting, front and back: a closed room has no cracks.
    constexpr int kCells = 16;
    RayMesh grid;
    for (int j = 0; j <= kCells; ++j)
        for (int i = 0; i <= kCells; ++i)
            grid.vertices.emplace_back(float(i) / 7, float(j) / 7, 1 + 0.01f * float((i * j) % 3));
    for (std::uint32_t j = 0; j < kCells; ++j)
        for (std::uint32_t i = 0; i < kCells; ++i) {
            const std::uint32_t a = j * (kCells + 1) + i, b = a + kCells + 1;
            grid.triangles.push_back({a, a + 1, b + 1});
            grid.triangles.push_back({a, b + 1, b});
        }
    grid.solid.assign(grid.triangles.size(), 0);
    const RayScene scene(std::array{grid});
    int lost = 0, shadowsLost = 0;
    for (std::size_t j = 1; j < kCells; ++j)
        for (std::size_t i = 1; i < kCells; ++i)
            for (std::size_t step : {std::size_t(0), std::size_t(1), std::size_t(kCells + 1),
                                     std::size_t(kCells + 2)}) {
                const std::size_t a = j * (kCells + 1) + i;
                const glm::vec3 p = 0.5f * (grid.vertices[a] + grid.vertices[a + step]);
                for (const glm::vec3 eye : {glm::vec3(p.x, p.y, 0), glm::vec3(1.1f, 0.9f, -3),
                                            glm::vec3(0.3f, 2.1f, 5)}) {
                    lost += !scene.nearest(eye, p - eye, 10).met();
                    shadowsLost += !scene.occluded(eye, eye + 2.0f * (p - eye));
                }
            }
    EXPECT_EQ(lost, 0);
    EXPECT_EQ(shadowsLost, 0);
}

TEST(RayScene, WithoutObjectsIsEmpty) {
    const RayScene scene(std::span<const RayMesh>{});
    EXPECT_FALSE(scene.occluded({0, 0, 0}, {1, 1, 1}));
    EXPECT_FALSE(scene.nearest({0, 0, 0}, {1, 1, 1}, 1e30f).met());
}

} // namespace

} // namespace penumbra
