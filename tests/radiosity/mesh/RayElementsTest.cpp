// Elements that rays meet by way of the triangles that they are traced against.
#include "radiosity/mesh/RayElements.h"
#include "radiosity/mesh/PosedPatches.h"
#include "radiosity/query/DrawnSurface.h"
#include "radiosity/rows/HemisphereRays.h"
#include "tests/support/BallData.h"
#include "tests/support/EditedScenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>

namespace penumbra {

namespace {

constexpr int kRays = 16;

/// What the rays of a point meet.
std::array<RayHit, kRays> met(const RayScene& rays, const HemisphereRays& directions,
                              const Receiver& from) {
    std::array<glm::vec3, kRays> along;
    for (int i = 0; i < kRays; ++i) along[std::size_t(i)] = directions.direction(i, from.normal);
    std::array<RayHit, kRays> hits;
    rays.nearest(from.position, along, 1e30f, RayScene::Faces::lit, hits);
    return hits;
}

/// How far a point lies beside an element at the most, in its plane; negative: on it [m].
float beside(const PatchSet& set, std::uint32_t element, glm::vec3 p) {
    std::array<glm::vec3, 4> corners;
    for (std::size_t k = 0; k < 4; ++k)
        corners[k] = set.vertices[set.uncoveredElements[element].vertices[k]].position;
    const glm::vec3 normal =
        glm::normalize(glm::cross(corners[2] - corners[0], corners[3] - corners[1]));
    float most = -1e30f;
    for (std::size_t k = 0; k < 4; ++k) {
        const glm::vec3 edge = corners[(k + 1) % 4] - corners[k];
        if (edge == glm::vec3(0)) continue;
        const glm::vec3 outwards = glm::cross(glm::normalize(edge), normal);
        most = std::max(most, glm::dot(outwards, p - corners[k]));
    }
    return most;
}

/// Has the rays of all nodes end on the elements that are drawn there; on an edge between two, on
/// either. \return number of rays
int expectAsDrawn(const PatchSet& set, const RayScene& rays) {
    const DrawnSurface drawn(set);
    const HemisphereRays directions(kRays);
    int count = 0;
    for (const Receiver& node : set.nodes) {
        if (isPadding(node)) continue;
        const auto hits = met(rays, directions, node);
        for (int i = 0; i < kRays; ++i) {
            const RayHit& hit = hits[std::size_t(i)];
            const glm::vec3 along = directions.direction(i, node.normal);
            const DrawnHit shown = drawn.nearest(node.position, along, 1e30f);
            EXPECT_EQ(hit.met(), shown.met());
            if (!hit.met() || !shown.met()) continue;
            const std::uint32_t element = elementAt(set, hit);
            EXPECT_NEAR(hit.distance, shown.distance, 1e-3f * set.elementSize);
            if (element != shown.element) {
                EXPECT_LT(beside(set, element, node.position + hit.distance * along),
                          2e-3f * set.elementSize)
                    << set.objects[hit.object.value].path;
            }
            ++count;
        }
    }
    return count;
}

TEST(RayElements, AreThoseThatAreDrawnThere) {
    for (std::uint32_t seed = 1; seed <= 4; ++seed) {
        EditableRoom room(seed);
        LitScene lit(placeScene(room.scene()), EditableRoom::meshing(), {.directOnly = true});
        for (int edit = 0; edit < 4; ++edit) {
            EXPECT_GT(expectAsDrawn(lit.patches(), lit.rays()), 1000);
            room.edit();
            lit.follow(placeScene(room.scene()));
        }
    }
}

TEST(RayElements, OfDenseMeshesSliversAndSheetsAreThoseThatAreDrawnThere) {
    // A star of triangles from one corner, too: elements of many shapes in one plane.
    MeshData star;
    star.points = {{0, 0, 1.5f}};
    for (int i = 0; i <= 9; ++i) {
        const float turn = 0.17f * float(i * i) / 9;
        star.points.emplace_back(1.4f * std::cos(turn), 1.4f * std::sin(turn), 1.5f);
    }
    for (std::uint32_t i = 1; i <= 9; ++i) {
        star.faceVertexCounts.push_back(3);
        for (const std::uint32_t corner : {0u, i, i + 1}) star.faceVertexIndices.push_back(corner);
    }
    star.doubleSided = true;
    star.materials = {paint(Rgb(0.5f))};
    const Scene scene = sceneOf(
        {object("room", boxData({-2, -2, 0}, {2, 2, 3}, true)),
         placed("ball", moved(-0.5, 0, 1), {std::make_shared<Mesh>("mesh", ballData(24, 0.6f))}),
         object("star", star), ceilingLight({0, 0, 2.9f}, 1, 0.5f)});
    const BuiltPatches built = meshed(scene, {.patchSize = 0.6f, .elementSize = 0.1f});
    EXPECT_GT(expectAsDrawn(built.patches, raysThrough(built.patches)), 5000);
}

TEST(RayElements, AfterEditsAreThoseOfTheSceneAsItStands) {
    const HemisphereRays directions(kRays);
    for (std::uint32_t seed = 1; seed <= 3; ++seed) {
        EditableRoom room(seed);
        LitScene lit(placeScene(room.scene()), EditableRoom::meshing(), {.directOnly = true});
        std::string said;
        for (int edit = 0; edit < 12; ++edit) {
            said += room.edit();
            lit.follow(placeScene(room.scene()));
        }
        const PatchSet& set = lit.patches();
        const RayScene fresh = raysThrough(set);
        for (const Receiver& node : set.nodes) {
            if (isPadding(node)) continue;
            const auto followed = met(lit.rays(), directions, node);
            const auto anew = met(fresh, directions, node);
            for (std::size_t i = 0; i < kRays; ++i) {
                ASSERT_EQ(elementAt(set, followed[i]), elementAt(set, anew[i])) << said;
                ASSERT_EQ(followed[i].distance, anew[i].distance);
            }
        }
    }
}

TEST(RayElements, OfFacesThatLieOnEachOtherTheSameIsMetWhateverTheOrderOfTheObjects) {
    const auto met = [](const std::string& first, const std::string& second) {
        const PatchSet set = meshed(sceneOf({object(first, floorData(0, 1, 0, 1, 0)),
                                             object(second, floorData(0, 1, 0, 1, 0))}),
                                    {.patchSize = 1, .elementSize = 0.25f})
                                 .patches;
        const RayHit hit =
            raysThrough(set).nearest({0.3f, 0.4f, 1}, {0, 0, -1}, 10, RayScene::Faces::lit);
        EXPECT_TRUE(hit.met());
        return set.objects[set.elementObject[elementAt(set, hit)].value].path;
    };
    EXPECT_EQ(met("a", "b"), met("b", "a"));
}

TEST(RayElements, ASideThatIsNotLitIsNotMet) {
    // The floor has a front alone, and the box is seen from inside of it.
    const Scene scene = sceneOf({object("floor", floorData(-1, 1, -1, 1, 0)),
                                 object("box", boxData({-1, -1, 1}, {1, 1, 2}, false))});
    const BuiltPatches built = meshed(scene, {.patchSize = 0.5f, .elementSize = 0.25f});
    const RayScene rays = raysThrough(built.patches);
    const auto lit = RayScene::Faces::lit;
    EXPECT_TRUE(rays.nearest({0.1f, 0.2f, 0.5f}, {0, 0, -1}, 10, lit).met());
    EXPECT_FALSE(rays.nearest({0.1f, 0.2f, -0.5f}, {0, 0, 1}, 1, lit).met());
    EXPECT_FALSE(rays.nearest({0.1f, 0.2f, 1.5f}, {0, 0, 1}, 10, lit).met());
    EXPECT_TRUE(rays.nearest({0.1f, 0.2f, 1.5f}, {0, 0, 1}, 10, RayScene::Faces::both).met());
}

} // namespace

} // namespace penumbra
