#include "radiosity/rows/Walls.h"

#include "tests/support/Scenes.h"

#include <gtest/gtest.h>

#include <random>

namespace penumbra {

namespace {

/// A wall [-1, 1] x [-1, 1] in the plane z = 0, and its mesh.
BuiltPatches wall() {
    return meshed(sceneOf({object("wall", floorData(-1, 1, -1, 1, 0))}), {.patchSize = 0.5f});
}

TEST(Walls, HideBoxesOnTheirTwoSides) {
    const BuiltPatches built = wall();
    const Walls walls(built.patches);
    const Bounds below{{-0.2f, -0.2f, -0.6f}, {0.2f, 0.2f, -0.2f}};
    EXPECT_TRUE(walls.between(below, {{-0.3f, -0.1f, 0.2f}, {0.3f, 0.2f, 0.9f}}).valid());
    EXPECT_TRUE(walls.between({{-0.3f, -0.1f, 0.2f}, {0.3f, 0.2f, 0.9f}}, below).valid());
    EXPECT_FALSE(walls.between(below, {{-0.3f, -0.1f, -0.2f}, {0.3f, 0.2f, 0.9f}}).valid())
        << "reaches through the wall";
    EXPECT_FALSE(walls.between(below, {{1.5f, -0.1f, 0.2f}, {4.3f, 0.2f, 0.4f}}).valid())
        << "is seen past its edge";
}

TEST(Walls, HideOnlyWhatNoRayReaches) {
    const BuiltPatches built = wall();
    const Walls walls(built.patches);
    const RayScene rays(built.patches.rayMeshes, built.patches.skin);
    std::mt19937 random(7);
    const auto number = [&](float low, float high) {
        return low + (high - low) * float(random()) / float(0xffffffffu);
    };
    const auto box = [&] {
        const glm::vec3 lower(number(-1.5f, 1), number(-1.5f, 1), number(-2, 1.5f));
        return Bounds{lower, lower + glm::vec3(number(0, 0.6f), number(0, 0.6f), number(0, 0.6f))};
    };
    int hidden = 0;
    for (int i = 0; i < 4000; ++i) {
        const Bounds a = box(), b = box();
        if (!walls.between(a, b).valid()) continue;
        ++hidden;
        for (int k = 0; k < 20; ++k) {
            const glm::vec3 from = glm::mix(a.lower, a.upper, glm::vec3(number(0, 1)));
            const glm::vec3 to = glm::mix(b.lower, b.upper, glm::vec3(number(0, 1)));
            EXPECT_TRUE(rays.occluded(from, to));
        }
    }
    EXPECT_GT(hidden, 200);
}

TEST(Walls, AreNotThereWhereTheFixedPartIsSmall) {
    const BuiltPatches built =
        meshed(sceneOf({object("tile", floorData(0, 0.1f, 0, 0.1f, 0))}), {.patchSize = 0.5f});
    EXPECT_TRUE(built.patches.walls.empty());
}

} // namespace

} // namespace penumbra
