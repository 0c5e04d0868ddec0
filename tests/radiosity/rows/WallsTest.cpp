#include "radiosity/rows/Walls.h"

#include "radiosity/rays/Shaft.h"

#include "tests/support/Scenes.h"

#include <gtest/gtest.h>

#include <random>

namespace penumbra {

namespace {

/// A wall [-1, 1] x [-1, 1] in the plane z = 0, and its mesh.
BuiltPatches wall() {
    return meshed(
        sceneOf({objectOf("wall", {std::make_shared<Mesh>("mesh", floorData(-1, 1, -1, 1, 0))})}),
        {.patchSize = 0.5f});
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

TEST(Walls, BesideABoxTellOfItsPointsWhatAllOfThemTell) {
    const BuiltPatches built = wall();
    const Walls walls(built.patches);
    std::mt19937 random(8);
    const auto number = [&](float low, float high) {
        return low + (high - low) * float(random()) / float(0xffffffffu);
    };
    const auto point = [&] { return glm::vec3(number(-2, 2), number(-2, 2), number(-1.5f, 1.5f)); };
    int hidden = 0, free = 0;
    for (int i = 0; i < 4000; ++i) {
        Bounds a, b;
        a.add(point()), a.add(a.lower + glm::vec3(number(0, 0.4f)));
        b.add(point()), b.add(point());
        const std::vector<std::uint32_t> beside = walls.beside(a, b);
        const glm::vec3 p = glm::mix(b.lower, b.upper, glm::vec3(number(0, 1)));
        const bool isHidden =
            std::ranges::any_of(beside, [&](std::uint32_t w) { return walls.isHidden(w, a, p); });
        EXPECT_EQ(isHidden, walls.between(a, {p, p}).valid());
        if (walls.between(a, b).valid()) EXPECT_TRUE(isHidden);
        (isHidden ? hidden : free) += 1;
    }
    EXPECT_GT(hidden, 200);
    EXPECT_GT(free, 200);
}

TEST(Walls, HideWhereTheirObjectIsAndOnlyIfItIsThere) {
    BuiltPatches built = wall();
    Walls walls(built.patches);
    const Bounds low{{-0.2f, -0.2f, -0.6f}, {0.2f, 0.2f, -0.2f}},
        middle{{-0.3f, -0.1f, 0.2f}, {0.3f, 0.2f, 0.3f}},
        high{{-0.3f, -0.1f, 0.7f}, {0.3f, 0.2f, 0.9f}};
    const auto expectHides = [&](bool belowMiddle, bool aboveMiddle, const char* what) {
        EXPECT_EQ(walls.between(low, middle).valid(), belowMiddle) << what;
        EXPECT_EQ(walls.between(middle, high).valid(), aboveMiddle) << what;
        EXPECT_EQ(walls.between(low, high).valid(), belowMiddle || aboveMiddle) << what;
    };
    expectHides(true, false, "as meshed");
    placeObject(built.patches, {0}, placementOf(moved(0, 0, 0.5)).pose);
    walls.place({0});
    expectHides(false, true, "raised");
    placeObject(built.patches, {0}, placementOf(moved(0, 3, 0.5)).pose);
    walls.place({0});
    expectHides(false, false, "to the side");
    placeObject(built.patches, {0},
                placementOf(glm::rotate(moved(0, 0, 0), 3.0, glm::dvec3(1, 0, 0))).pose);
    walls.place({0});
    expectHides(true, false, "nearly upside down");
    built.patches.objects[0].present = false;
    walls.place({0});
    expectHides(false, false, "hidden");
    built.patches.objects[0].present = true;
    walls.place({0});
    expectHides(true, false, "shown");
}

TEST(Walls, AreLaidOutObjectByObjectInTheirFrames) {
    const auto box =
        objectOf("box", {std::make_shared<Mesh>("mesh", boxData({-1, -1, -1}, {1, 1, 1}, false))});
    box->setMatrix(moved(7, 2, 1) * scaled(2));
    const BuiltPatches built = meshed(sceneOf({object("tile", floorData(0, 0.1f, 0, 0.1f, 0)), box,
                                               object("floor", floorData(-1, 1, -1, 1, 0))}),
                                      {.patchSize = 0.5f});
    const PatchSet& set = built.patches;
    ASSERT_EQ(set.walls.size(), 7u);
    for (std::uint32_t o = 0; o < set.objects.size(); ++o) {
        const ObjectPart& part = set.objects[o];
        EXPECT_EQ(part.walls.count, part.path == "/box" ? 6u : part.path == "/floor" ? 1u : 0u);
        EXPECT_EQ(part.shape.walls.size(), part.walls.count);
        for (std::uint32_t i = part.walls.first; i < part.walls.end(); ++i) {
            EXPECT_EQ(set.walls[i].object.value, o);
            for (const glm::vec3 corner : set.walls[i].outline)
                EXPECT_TRUE(grown(boundsOf(set, {o}), 1e-5f).contains(corner));
        }
    }
    EXPECT_NEAR(set.objects[1].shape.walls[0].outline[0].x, -2, 1e-6);
    EXPECT_NEAR(set.walls[set.objects[1].walls.first].outline[0].x, 5, 1e-6);
}

TEST(Walls, AreNotThereWhereFacesAreSmall) {
    const BuiltPatches built =
        meshed(sceneOf({object("tile", floorData(0, 0.1f, 0, 0.1f, 0))}), {.patchSize = 0.5f});
    EXPECT_TRUE(built.patches.walls.empty());
}

} // namespace

} // namespace penumbra
