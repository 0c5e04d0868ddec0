// Where light can get to, and where it can't.
#include "radiosity/transport/Reach.h"
#include "tests/support/EditedScenes.h"
#include "tests/support/RoomsWithDoor.h"

#include <gtest/gtest.h>

#include <string>

namespace penumbra {

namespace {

constexpr MeshingOptions kCoarse{.patchSize = 0.5f, .elementSize = 0.25f};

/// Where light gets to in a scene when the patches of one object are lit.
struct Reached {
    LitScene scene;
    const PatchSet& set = scene.patches();
    NodeHits hits{set, scene.rays()};
    Reach reach;

    Reached(const Scene& from, const std::string& lit)
        : scene(placeScene(from), kCoarse, {.directOnly = true}) {
        while (hits.work(1 << 20)) {
        }
        std::vector<std::uint8_t> bright(set.patches.size());
        for (std::size_t p = 0; p < bright.size(); ++p)
            bright[p] = set.objects[set.patches[p].object.value].path == lit;
        reach = findReach(set, hits, bright);
    }
    /// Share of an object's nodes that can be reached, of those for which `which` is true and that
    /// nothing covers.
    template <class Which>
    double share(const std::string& path, const Which& which) const {
        std::size_t nodes = 0, reached = 0;
        for (const ObjectPart& part : set.objects) {
            if (part.path != path) continue;
            for (std::uint32_t n = part.nodes.first; n < part.nodes.end(); ++n) {
                const Receiver& node = set.nodes[n];
                if (isPadding(node) || !which(node)) continue;
                ++nodes;
                reached += reach.node(n);
            }
        }
        return nodes > 0 ? double(reached) / double(nodes) : 0;
    }
    /// The same, but for what stands on something.
    double share(const std::string& path) const {
        return share(path, [](const Receiver& node) { return node.normal.z > -0.5f; });
    }
};

TEST(Reach, LightGetsAllOverTheRoomItIsIn) {
    EXPECT_EQ(Reached(RoomsWithDoor().scene, "/wall").share("/first"), 1);
    EXPECT_EQ(Reached(RoomsWithDoor().scene, "/second").share("/box"), 1);
}

TEST(Reach, LightDoesNotGetThroughAShutDoor) {
    const Reached rooms(RoomsWithDoor().scene, "/first");
    for (const char* path : {"/second", "/box", "/cupboard"})
        EXPECT_EQ(rooms.share(path), 0) << path;
}

TEST(Reach, LightGetsThroughAnOpenDoorByWayOfTheWallsBehindIt) {
    RoomsWithDoor rooms;
    rooms.open();
    const Reached open(rooms.scene, "/first");
    for (const char* path : {"/second", "/box"}) EXPECT_EQ(open.share(path), 1) << path;
}

TEST(Reach, LightDoesNotGetIntoAClosedCupboard) {
    const Reached rooms(RoomsWithDoor().scene, "/second");
    const auto inside = [](const Receiver& node) {
        // Its inner sides face its middle.
        return glm::dot(node.normal, glm::vec3(3.5f, 1.5f, 0.3f) - node.position) > 0;
    };
    const auto outside = [&](const Receiver& node) { return !inside(node); };
    EXPECT_EQ(rooms.share("/cupboard", inside), 0);
    EXPECT_NEAR(rooms.share("/cupboard", outside), 5.0 / 6, 1e-9) << "its bottom is on the floor";
}

TEST(Reach, WhatIsHiddenIsNotReached) {
    RoomsWithDoor rooms;
    const auto shown = std::make_shared<Switch>("shown");
    ASSERT_TRUE(rooms.scene.root->remove(rooms.box));
    shown->add(rooms.box);
    rooms.scene.root->add(shown);
    EXPECT_EQ(Reached(rooms.scene, "/second").share("/shown/box"), 1);
    shown->setVisible(false);
    EXPECT_EQ(Reached(rooms.scene, "/second").share("/shown/box"), 0);
}

TEST(Reach, WithoutLightNothingIsReached) {
    const Reached rooms(RoomsWithDoor().scene, "/nothing");
    for (const std::uint64_t bits : rooms.reach.nodes) EXPECT_EQ(bits, 0u);
}

TEST(Reach, IsTheLeastSetThatIsClosed) {
    // Found the slow way: all nodes, again and again, until nothing changes.
    for (std::uint32_t seed = 1; seed <= 4; ++seed) {
        const EditableRoom room(seed);
        const LitScene lit(placeScene(room.scene()), EditableRoom::meshing(), {.directOnly = true});
        const PatchSet& set = lit.patches();
        NodeHits hits(set, lit.rays());
        while (hits.work(1 << 20)) {
        }
        std::mt19937 random(seed);
        std::vector<std::uint8_t> some(set.patches.size());
        for (int i = 0; i < 3; ++i) {
            const std::size_t p = random() % set.parts.firstPatch;
            some[p] = set.sends(std::uint32_t(p));
        }
        std::vector<std::uint8_t> bright = some, reached(set.nodes.size());
        const auto isReached = [&](std::uint32_t n) { return reached[n] != 0; };
        for (bool changed = true; changed;) {
            changed = false;
            for (std::uint32_t n = 0; n < reached.size(); ++n)
                for (const std::uint32_t hit : hits.hits(n)) {
                    if (isPadding(set.nodes[n]) || hit == Element::kNone ||
                        !hits.isThere(set.nodeBlockObject[n / PatchSet::kBlock]))
                        continue;
                    if (set.receives(hit) && bright[set.elements[hit].patch]) reached[n] = 1;
                }
            for (std::uint32_t p = 0; p < bright.size(); ++p) {
                const Patch& patch = set.patches[p];
                if (bright[p] || !set.sends(p) ||
                    !(isReached(patch.centreNode) ||
                      (patch.hasCornerNodes && std::ranges::any_of(patch.cornerNodes, isReached))))
                    continue;
                bright[p] = 1;
                changed = true;
            }
        }
        const Reach reach = findReach(set, hits, some);
        EXPECT_EQ(reach.patches, bright) << "seed " << seed;
        for (std::uint32_t n = 0; n < reached.size(); ++n)
            ASSERT_EQ(reach.node(n), isReached(n)) << "seed " << seed << ", node " << n;
    }
}

} // namespace

} // namespace penumbra
