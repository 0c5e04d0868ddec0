// After any sequence of edits the settled light is that of the scene as it is, however it came
// to be. `scripts/nightly` tries many more sequences.
#include "base/Error.h"
#include "base/Parallel.h"
#include "tests/support/EditedScenes.h"
#include "tests/support/EditedWalls.h"
#include "tests/support/LitDifference.h"
#include "tests/support/Refurnishing.h"
#include "tests/support/RoomsWithDoor.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <memory>
#include <utility>

namespace penumbra {

namespace {

/// Half of the rooms get clusters.
SolverOptions tight(std::uint32_t seed) {
    SolverOptions options{.residual = 1e-4};
    options.clusters = seed % 2 == 0;
    return options;
}

/// A room that is edited, what was done to it, and the light that follows.
struct FollowedRoom {
    EditableRoom room;
    SolverOptions solving;
    LitScene lit;
    Refurnishing furniture;
    std::string said;

    /// A third of the rooms has no room for what comes: it is meshed anew.
    explicit FollowedRoom(std::uint32_t seed)
        : room(seed), solving(tight(seed)),
          lit(placeScene(room.scene()), EditableRoom::meshing(), solving, seed % 3 != 0),
          furniture(room.scene(), seed) {}
    void follow() { lit.follow(placeScene(room.scene())); }
    void edit() {
        said += room.edit();
        follow();
    }
    void refurnish() {
        said += furniture.edit();
        follow();
    }
    /// Settles, here and from scratch. \return what differs
    std::string differs() {
        lit.solver().settle();
        LitScene scratch(placeScene(room.scene()), sizesOf(lit.patches()), solving);
        scratch.solver().settle();
        return difference(lit, scratch);
    }
};

std::uint32_t anySeed() {
    return *rc::gen::noShrink(
        rc::gen::resize(rc::kNominalSize, rc::gen::arbitrary<std::uint32_t>()));
}

/// Edits that are worked off one by one. \return what differs in the end
std::string differsAfterSettledEdits(FollowedRoom& followed, int edits) {
    for (; edits > 0; --edits) {
        followed.edit();
        followed.lit.solver().settle();
    }
    return followed.differs();
}

RC_GTEST_PROP(Incremental, EqualsFromScratchAfterEditsThatSettle, ()) {
    FollowedRoom followed(anySeed());
    const std::string differs = differsAfterSettledEdits(followed, *rc::gen::inRange(1, 9));
    if (!differs.empty()) RC_FAIL("after " + followed.said + "\n" + differs);
}

/// Edits that come while earlier ones are not yet worked off. \return what differs in the end
std::string differsAfterOverlappingEdits(FollowedRoom& followed, std::uint32_t seed, int edits) {
    std::mt19937 random(seed);
    for (; edits > 0; --edits) {
        followed.edit();
        // Settled, interrupted, or not begun when the next edit comes.
        if (random() % 6 == 0) followed.lit.solver().settle();
        for (std::uint32_t pieces = random() % 3 * (random() % 100); pieces > 0; --pieces)
            followed.lit.solver().step(1e-9);
    }
    return followed.differs();
}

RC_GTEST_PROP(Incremental, EqualsFromScratchAfterEditsThatOverlap, ()) {
    const std::uint32_t seed = anySeed();
    FollowedRoom followed(seed);
    const std::string differs =
        differsAfterOverlappingEdits(followed, seed, *rc::gen::inRange(1, 31));
    if (!differs.empty()) RC_FAIL("after " + followed.said + "\n" + differs);
}

/// Things are brought in, resized and taken out, besides moves, settled or not. \return what
/// differs
std::string differsAfterRefurnishing(FollowedRoom& followed, std::uint32_t seed, int edits) {
    std::mt19937 random(seed);
    for (; edits > 0; --edits) {
        random() % 3 == 0 ? followed.edit() : followed.refurnish();
        if (random() % 3 == 0) followed.lit.solver().settle();
        for (std::uint32_t pieces = random() % 3 * (random() % 100); pieces > 0; --pieces)
            followed.lit.solver().step(1e-9);
    }
    return followed.differs();
}

RC_GTEST_PROP(Incremental, EqualsFromScratchAfterThingsAreBroughtInResizedAndTakenOut, ()) {
    const std::uint32_t seed = anySeed();
    FollowedRoom followed(seed);
    const std::string differs = differsAfterRefurnishing(followed, seed, *rc::gen::inRange(1, 9));
    if (!differs.empty())
        RC_FAIL("seed " + std::to_string(seed) + " after " + followed.said + "\n" + differs);
}

/// Partitions, the table and the room are moved, hidden, resized and taken out, besides other
/// edits, settled or not. \return what differs
std::string differsAfterMovedWalls(std::uint32_t seed, int edits) {
    EditableRoom room(seed);
    EditedWalls walls(room.scene(), seed);
    SolverOptions solving = tight(seed);
    solving.directOnly = seed % 3 != 0;
    LitScene lit(placeScene(room.scene()), EditableRoom::meshing(), solving);
    std::mt19937 random(seed);
    std::string said;
    for (; edits > 0; --edits) {
        for (std::uint32_t more = 1 + random() % 2; more > 0; --more)
            said += random() % 3 == 0 ? room.edit() : walls.edit();
        lit.follow(placeScene(room.scene()));
        if (random() % 3 == 0) lit.solver().settle();
        for (std::uint32_t pieces = random() % 3 * (random() % 100); pieces > 0; --pieces)
            lit.solver().step(1e-9);
    }
    lit.solver().settle();
    LitScene scratch(placeScene(room.scene()), sizesOf(lit.patches()), solving);
    scratch.solver().settle();
    const std::string differs = difference(lit, scratch);
    return differs.empty() ? differs
                           : "seed " + std::to_string(seed) + " after " + said + "\n" + differs;
}

RC_GTEST_PROP(Incremental, EqualsFromScratchAfterWallsAreMoved, ()) {
    const std::uint32_t seed = anySeed();
    const std::string differs = differsAfterMovedWalls(seed, *rc::gen::inRange(1, 13));
    if (!differs.empty()) RC_FAIL(differs);
}

TEST(Incremental, EndsAlikeOnOneTwoThreeAndEightThreads) {
    for (std::uint32_t seed = 1; seed <= 6; ++seed) {
        std::unique_ptr<FollowedRoom> first; // on one thread
        for (const unsigned threads : {1u, 2u, 3u, 8u}) {
            const ThreadLimit limit(threads);
            auto followed = std::make_unique<FollowedRoom>(seed);
            for (int edits = 0; edits < 4; ++edits) {
                edits % 2 == 0 ? followed->edit() : followed->refurnish();
                followed->lit.solver().settle();
            }
            if (!first)
                first = std::move(followed);
            else
                EXPECT_EQ(difference(first->lit, followed->lit), "")
                    << threads << " threads, seed " << seed << " after " << first->said;
        }
    }
}

TEST(Incremental, EqualsFromScratchWhereAWallHidesAThingButNotTheReceiversThatHoverOverIt) {
    EXPECT_EQ(differsAfterMovedWalls(115473237, 4), "");
}

TEST(Incremental, EqualsFromScratchWhereAReceiverLiesInThePlaneOfASender) {
    // A box against the wall, and a node of the floor in the plane of its side up to one rounding:
    // rays along that side, and along that of a thing below it, met its edges or did not.
    constexpr std::uint32_t kSeed = 475502491;
    FollowedRoom followed(kSeed);
    EXPECT_EQ(differsAfterOverlappingEdits(followed, kSeed, 11), "") << followed.said;
}

TEST(Incremental, EqualsFromScratchWhereAReceiverLiesInThePlaneOfAFaceInBetween) {
    // And so does the middle of a quarter of the sender, for all of them are at round numbers.
    constexpr std::uint32_t kSeed = 4115628356;
    FollowedRoom followed(kSeed);
    EXPECT_EQ(differsAfterOverlappingEdits(followed, kSeed, 6), "") << followed.said;
}

TEST(Incremental, EqualsFromScratchWhereRaysPassByAnEdge) {
    // A box touches a light, and another one a pebble, so that rays run into an edge of the box:
    // which of the two faces they met depended on how the hierarchy of its triangles came to be.
    constexpr std::array<std::pair<std::uint32_t, int>, 2> kRooms{
        {{1718266436, 4}, {4290188502, 3}}};
    for (const auto& [seed, edits] : kRooms) {
        FollowedRoom followed(seed);
        EXPECT_EQ(differsAfterOverlappingEdits(followed, seed, edits), "") << followed.said;
    }
}

TEST(Incremental, EqualsFromScratchWhereAShadowRayGrazesABox) {
    // By rounding it passes beside a triangle that is reported as hit, if the boxes of the
    // hierarchy let it through: those of the box alone did, those of the whole scene did not.
    FollowedRoom followed(2464783612);
    EXPECT_EQ(differsAfterSettledEdits(followed, 4), "") << followed.said;
}

TEST(Incremental, EqualsFromScratchWhereARayGrazesSomethingAtItsVeryBeginning) {
    // It is in doubt there, and is asked again a hair aside. A ray that was turned aside instead
    // met something else altogether.
    FollowedRoom settled(795163583);
    EXPECT_EQ(differsAfterSettledEdits(settled, 4), "") << settled.said;
    constexpr std::uint32_t kSeed = 2796649543;
    FollowedRoom overlapping(kSeed);
    EXPECT_EQ(differsAfterOverlappingEdits(overlapping, kSeed, 13), "") << overlapping.said;
}

TEST(Incremental, EqualsFromScratchWhereARayPassesByAnEdgeOfSomethingFarAway) {
    // It ran through the edge of a box a metre off, left it twice, and a corner of the wall was
    // taken to lie inside of the box, also when that had gone.
    FollowedRoom followed(1061699245);
    EXPECT_EQ(differsAfterSettledEdits(followed, 1), "") << followed.said;
}

TEST(Incremental, EqualsFromScratchWhenThereIsNoMoreRoomForWhatComes) {
    // The same thing comes, ever larger, in place of itself, until the scene is meshed anew.
    FollowedRoom followed(4);
    const auto thing = objectOf(
        "added", {std::make_shared<Mesh>("mesh", boxData({0, 0, 0}, {0.4f, 0.4f, 0.4f}, false))});
    followed.room.scene().root->add(thing);
    int comes = 0;
    for (bool added = true; added; ++comes) {
        thing->setMatrix(moved(1, 1, 1) * scaled(1 + 0.02 * comes));
        added = followed.lit.follow(placeScene(followed.room.scene())).added;
        if (comes % 10 == 0) followed.lit.solver().settle();
    }
    EXPECT_GT(comes, 8);
    EXPECT_EQ(followed.differs(), "");
}

/// A block of .4 m, at a place of the room, of which it is a thing.
std::shared_ptr<Transform> addBlock(FollowedRoom& followed, const std::string& name,
                                    const glm::dmat4& place,
                                    std::shared_ptr<Material> material = paint(Rgb(0.5f))) {
    const auto block =
        objectOf(name, {std::make_shared<Mesh>("mesh", boxData({0, 0, 0}, {0.4f, 0.4f, 0.4f}, false,
                                                               std::move(material)))});
    block->setMatrix(place);
    followed.room.scene().root->add(block);
    return block;
}

TEST(Incremental, EqualsFromScratchWhenSomethingShrinksToNothingAsAnotherThingIsResized) {
    // What had no surface took from what came with it where its corners meet.
    FollowedRoom followed(4);
    const auto resized = addBlock(followed, "resized", moved(1, 1, 0));
    const auto shrunk = addBlock(followed, "shrunk", moved(1.4, 1, 0));
    followed.follow();
    followed.lit.solver().settle();
    resized->setMatrix(resized->matrix() * scaled(1.3));
    shrunk->setMatrix(shrunk->matrix() * scaled(0));
    followed.follow();
    EXPECT_EQ(followed.differs(), "");
    shrunk->setMatrix(moved(1.4, 1, 0));
    followed.follow();
    EXPECT_EQ(followed.differs(), "") << "it has grown again";
}

TEST(Incremental, EqualsFromScratchWhenSomethingThatShinesShrinksToAPoint) {
    // Too small for floats to tell its corners apart, and yet not gone.
    FollowedRoom followed(4);
    const auto block = addBlock(followed, "glowing", moved(1, 1, 0.5), paint(Rgb(0.5f), Rgb(5)));
    followed.follow();
    followed.lit.solver().settle();
    block->setMatrix(moved(1, 1, 0.5) * scaled(1e-9));
    followed.follow();
    EXPECT_EQ(followed.differs(), "");
    block->setMatrix(moved(1, 1, 0.5));
    followed.follow();
    EXPECT_EQ(followed.differs(), "") << "it has grown again";
}

TEST(Incremental, EqualsFromScratchWhenSomethingThatWasMeshedInTheDarkShinesAgain) {
    // Others of its material, gone or not, were taken to shine for it.
    FollowedRoom followed(4);
    const auto glow = paint(Rgb(0.5f), Rgb(5));
    const auto block = addBlock(followed, "glowing", moved(1, 1, 0.5), glow);
    addBlock(followed, "beside", moved(0.3, 1, 0.5), glow);
    followed.follow();
    glow->setEmission(Rgb());
    followed.follow();
    block->setMatrix(block->matrix() * scaled(1.2));
    followed.follow();
    addBlock(followed, "late", moved(1, 0.3, 0.5), glow);
    followed.follow();
    followed.lit.solver().settle();
    glow->setEmission(Rgb(5));
    followed.follow();
    EXPECT_EQ(followed.differs(), "");
}

/// Direct and indirect light at all vertices that are drawn, summed.
double lightIn(const LitScene& lit) {
    const Lighting light = lit.solver().lighting();
    double sum = 0;
    for (const std::vector<Rgb>& part : {light.direct, light.indirect})
        for (const Rgb& value : part) sum += double(maxChannel(value));
    return sum;
}

TEST(Incremental, LeavesNothingOfLightThatWentOut) {
    RoomsWithDoor rooms;
    const MeshingOptions meshing{.patchSize = 0.5f, .elementSize = 0.25f};
    LitScene lit(placeScene(rooms.scene), meshing, tight(0));
    lit.solver().settle();
    EXPECT_GT(lightIn(lit), 0);
    for (const Rgb luminance : {Rgb(), Rgb(1)}) {
        rooms.light->setLuminance(luminance);
        rooms.box->setMatrix(moved(0.1, 0, 0) * rooms.box->matrix());
        lit.follow(placeScene(rooms.scene));
        lit.solver().settle();
        LitScene scratch(placeScene(rooms.scene), meshing, tight(0));
        scratch.solver().settle();
        EXPECT_EQ(difference(lit, scratch), "");
        EXPECT_EQ(lightIn(lit) > 0, luminance.r > 0);
    }
}

TEST(Incremental, EqualsFromScratchAfterAnEditThatWasRefused) {
    FollowedRoom followed(4);
    const auto near = addBlock(followed, "near", moved(1, 1, 0));
    const auto far = addBlock(followed, "far", moved(1.4, 1, 0));
    followed.follow();
    near->setMatrix(moved(1, 1.2, 0));
    far->setMatrix(moved(1e13, 0, 0));
    EXPECT_THROW(followed.follow(), Error);
    EXPECT_THROW(followed.follow(), Error) << "again, for it still is nowhere";
    far->setMatrix(moved(1.4, 1, 0));
    followed.follow();
    EXPECT_EQ(followed.differs(), "");
}

TEST(Incremental, EqualsFromScratchWhereNoLightShines) {
    // What is lit is found last then, after the rows of what light may come to reach.
    constexpr std::uint32_t kSeed = 2163954167;
    FollowedRoom followed(kSeed);
    EXPECT_EQ(differsAfterOverlappingEdits(followed, kSeed, 9), "") << followed.said;
}

/// Two rooms with a door between them, lit as the door and what is behind it are moved.
struct FollowedDoor {
    RoomsWithDoor rooms;
    SolverOptions solving;
    LitScene lit{placeScene(rooms.scene), {.patchSize = 0.5f, .elementSize = 0.25f}, solving};

    explicit FollowedDoor(const SolverOptions& options) : solving(options) {
        lit.solver().settle();
    }
    /// Follows an edit. \return what differs from a fresh start
    std::string follow() {
        EXPECT_FALSE(lit.follow(placeScene(rooms.scene)).rebuilt);
        lit.solver().settle();
        LitScene scratch(placeScene(rooms.scene), sizesOf(lit.patches()), solving);
        scratch.solver().settle();
        return difference(lit, scratch);
    }
    /// Share of an object's nodes that light gets to, of those for which `which` is true and that
    /// nothing covers.
    template <class Which>
    double reached(const std::string& path, const Which& which) const {
        std::size_t nodes = 0, reached = 0;
        for (const ObjectPart& part : lit.patches().objects)
            for (std::uint32_t n = part.nodes.first; part.path == path && n < part.nodes.end(); ++n)
                if (const Receiver& node = lit.patches().nodes[n];
                    !isPadding(node) && which(node)) {
                    ++nodes;
                    reached += lit.solver().indirect().reached(n);
                }
        return nodes > 0 ? double(reached) / double(nodes) : 0;
    }
    /// But for what stands on something.
    double reached(const std::string& path) const {
        return reached(path, [](const Receiver& node) { return node.normal.z > -0.5f; });
    }
    double reachedInCupboard() const {
        const auto middle = glm::vec3(rooms.cupboard->matrix() * glm::dvec4(0, 0, 0.3, 1));
        return reached("/cupboard", [&](const Receiver& node) {
            return glm::dot(node.normal, middle - node.position) > 0;
        });
    }
    /// Entries of all rows onto the nodes of an object.
    std::size_t entriesOnto(const std::string& path) const {
        std::size_t count = 0;
        for (const ObjectPart& part : lit.patches().objects)
            for (std::uint32_t b = part.nodes.first / PatchSet::kBlock;
                 part.path == path && b * PatchSet::kBlock < part.nodes.end(); ++b)
                for (const Row& row : lit.solver().patchRows())
                    if (const RowBlock* block = row.find(b)) count += block->entryCount();
        return count;
    }
};

const std::array<SolverOptions, 3> kWays{{{.residual = 1e-4},
                                          {.residual = 1e-4, .clusters = false},
                                          {.residual = 1e-4, .detail = false}}};

TEST(Incremental, BehindADoorLightIsWhereItIsFromScratch) {
    for (const SolverOptions& way : kWays) {
        FollowedDoor door(way);
        EXPECT_EQ(door.reached("/second"), 0);
        EXPECT_EQ(door.entriesOnto("/second"), 0u);
        for (int i = 0; i < 2; ++i) {
            door.rooms.open();
            EXPECT_EQ(door.follow(), "") << "opened";
            EXPECT_EQ(door.reached("/second"), 1);
            EXPECT_EQ(door.reached("/box"), 1);
            EXPECT_GT(door.reached("/cupboard"), 0.3);
            EXPECT_EQ(door.reachedInCupboard(), 0) << "it is closed";
            EXPECT_GT(door.entriesOnto("/second"), 0u);
            door.rooms.box->setMatrix(moved(2.8, 1, 0));
            door.rooms.cupboard->setMatrix(moved(3.5, 0.5 + i, 0));
            EXPECT_EQ(door.follow(), "") << "moved in the light";
            door.rooms.shut();
            EXPECT_EQ(door.follow(), "") << "shut";
            for (const char* path : {"/second", "/box", "/cupboard"}) {
                EXPECT_EQ(door.reached(path), 0) << path;
                EXPECT_EQ(door.entriesOnto(path), 0u) << path;
            }
            door.rooms.box->setMatrix(moved(3, 1, 0));
            EXPECT_EQ(door.follow(), "") << "moved in the dark";
        }
    }
}

TEST(Incremental, ALightThatIsOffReachesWhatItDidWithoutARay) {
    FollowedDoor door(kWays[0]);
    door.rooms.light->setLuminance(Rgb(0.0f));
    const std::uint64_t rays = door.lit.solver().done().rays;
    EXPECT_EQ(door.follow(), "");
    EXPECT_EQ(door.lit.solver().done().rays, rays);
    EXPECT_EQ(door.reached("/first"), 1);
    EXPECT_EQ(door.reached("/second"), 0);
}

TEST(Incremental, UnderABoxThatIsPutOnTheFloorLightIsWhereItIsFromScratch) {
    for (const SolverOptions& way : kWays) {
        FollowedDoor door(way);
        door.rooms.box->setMatrix(moved(1, 1, 0)); // into the lit room
        EXPECT_EQ(door.follow(), "");
        door.rooms.box->setMatrix(moved(1.1, 0.9, 0.5));
        EXPECT_EQ(door.follow(), "");
        EXPECT_EQ(door.reached("/box"), 1);
        door.rooms.box->setMatrix(moved(1.1, 0.9, 0));
        EXPECT_EQ(door.follow(), "");
    }
}

TEST(Incremental, ADoorThatSlamsWhileLightIsUnderWayEndsAsFromScratch) {
    for (const SolverOptions& way : kWays) {
        FollowedDoor door(way);
        for (int pieces = 1; pieces <= 4096; pieces *= 4) {
            door.rooms.open();
            EXPECT_FALSE(door.lit.follow(placeScene(door.rooms.scene)).rebuilt);
            for (int i = 0; i < pieces; ++i) door.lit.solver().work(600);
            door.rooms.shut();
            EXPECT_EQ(door.follow(), "") << "after " << pieces;
            EXPECT_EQ(door.entriesOnto("/second"), 0u);
        }
    }
}

TEST(Incremental, WhatIsHiddenWhileOthersAreReplacedComesBackAsFromScratch) {
    // What its rays met was gone at the first meshing anew, and asked for at the second.
    FollowedDoor door(kWays[0]);
    const auto shown = std::make_shared<Switch>("shown");
    ASSERT_TRUE(door.rooms.scene.root->remove(door.rooms.box));
    shown->add(door.rooms.box);
    door.rooms.scene.root->add(shown);
    const auto follow = [&] {
        door.lit.follow(placeScene(door.rooms.scene));
        door.lit.solver().settle();
    };
    follow();
    shown->setVisible(false);
    follow();
    for (int i = 0; i < 2; ++i) {
        door.rooms.cupboard->setMatrix(door.rooms.cupboard->matrix() * scaled(0.9));
        follow();
    }
    shown->setVisible(true);
    EXPECT_EQ(door.follow(), "");
}

} // namespace

} // namespace penumbra
