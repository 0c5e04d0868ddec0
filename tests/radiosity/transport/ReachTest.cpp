// Where light can get to, and where it can't.
#include "radiosity/transport/Reach.h"
#include "tests/support/Scenes.h"

#include <gtest/gtest.h>

namespace penumbra {

namespace {

constexpr MeshingOptions kCoarse{.patchSize = 0.5f, .elementSize = 0.25f};

/// Two closed rooms side by side, with a light in the first and a box in each. The box in the
/// second can be moved.
Scene twoRooms(bool withDoor) {
    MeshData first;
    addBox(first, {0, 0, 0}, {2, 2, 2}, true, {0, 2, 3, 4, 5});
    MeshData second;
    addBox(second, {2.1f, 0, 0}, {4, 2, 2}, true, {1, 2, 3, 4, 5});
    MeshData wall;
    if (withDoor) { // a hole above the wall
        addBox(wall, {2, 0, 0}, {2.1f, 2, 1.2f}, false);
        addBox(wall, {2, 0, 2}, {2.1f, 2, 2.1f}, false);
    } else {
        addBox(wall, {2, 0, 0}, {2.1f, 2, 2}, false);
    }
    for (MeshData* mesh : {&first, &second, &wall}) mesh->materials = {paint(Rgb(0.5f))};
    const auto box = [] {
        return std::make_shared<Mesh>("mesh",
                                      boxData({-0.2f, -0.2f, 0}, {0.2f, 0.2f, 0.4f}, false));
    };
    const auto moves = movable("moves", {box()});
    moves->setMatrix(moved(3, 1, 0.8));
    return sceneOf({object("first", first), object("second", second), object("wall", wall),
                    placed("stays", moved(1, 1, 0.5), {box()}), moves,
                    ceilingLight({1, 1, 1.99f}, 0.5f, 0.5f)});
}

/// Shares of an object's nodes that can be reached when the patches of `lit` are lit.
double reachedShare(const PatchSet& set, const std::string& path, const std::string& lit) {
    std::vector<std::uint8_t> bright(set.patches.size());
    for (std::size_t p = 0; p < bright.size(); ++p)
        bright[p] = set.objects[set.patches[p].object.value].path == lit;
    const std::vector<std::uint64_t> bits = Reach(set).spread(bright);
    std::size_t nodes = 0, reached = 0;
    for (const ObjectPart& part : set.objects) {
        if (part.path != path) continue;
        for (std::uint32_t n = part.nodes.first; n < part.nodes.end(); ++n) {
            if (isPadding(set.uncoveredNodes[n])) continue;
            ++nodes;
            reached += bits[n / 64] >> n % 64 & 1;
        }
    }
    return double(reached) / double(nodes);
}

TEST(Reach, LightGetsAllOverTheRoomItIsIn) {
    const BuiltPatches built = meshed(twoRooms(false), kCoarse);
    EXPECT_EQ(reachedShare(built.patches, "/first", "/stays"), 1);
    EXPECT_EQ(reachedShare(built.patches, "/stays", "/first"), 1);
}

TEST(Reach, LightDoesNotGetThroughAWall) {
    const BuiltPatches built = meshed(twoRooms(false), kCoarse);
    EXPECT_EQ(reachedShare(built.patches, "/second", "/stays"), 0);
}

TEST(Reach, LightGetsThroughADoorByWayOfTheWallsBehindIt) {
    const BuiltPatches built = meshed(twoRooms(true), kCoarse);
    EXPECT_EQ(reachedShare(built.patches, "/second", "/stays"), 1);
}

TEST(Reach, WhatIsMovableCanAlwaysBeReached) {
    // It may be carried into the light, and nothing is to be traced then.
    const BuiltPatches built = meshed(twoRooms(false), kCoarse);
    EXPECT_EQ(reachedShare(built.patches, "/moves", "/stays"), 1);
    EXPECT_EQ(reachedShare(built.patches, "/moves", "/nothing"), 1);
}

TEST(Reach, WithoutLightNothingFixedIsReached) {
    Scene scene = twoRooms(true);
    const NodePtr moves = scene.root->children()[4];
    ASSERT_TRUE(scene.root->remove(moves));
    const BuiltPatches built = meshed(scene, kCoarse);
    for (const char* path : {"/first", "/second", "/wall", "/stays"})
        EXPECT_EQ(reachedShare(built.patches, path, "/nothing"), 0) << path;
}

} // namespace

} // namespace penumbra
