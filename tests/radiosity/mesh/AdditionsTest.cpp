// Objects that come to a patch set.
#include "radiosity/mesh/Additions.h"
#include "radiosity/mesh/ScenePieces.h"
#include "tests/support/Scenes.h"

#include <gtest/gtest.h>

namespace penumbra {

namespace {

constexpr MeshingOptions kSizes{.patchSize = 0.5f, .elementSize = 0.25f, .backdropArea = 1e9};

/// A room, and a box and a light that come to it.
struct Additions : ::testing::Test {
    Scene scene =
        sceneOf({object("room", boxData({-2, -2, -2}, {2, 2, 2}, true)),
                 object("box", boxData({0, 0, -2}, {0.7f, 0.8f, -1}, false)),
                 placed("lamp", moved(0, 0, 1.9),
                        {std::make_shared<Light>("light", RectShape{0.6f, 0.4f}, Rgb(10))})});
    PlacedScene all = placeScene(scene);
    std::vector<glm::vec3> light{{0, 0, 1.8f}};
    BuiltPatches set = buildObjects(partOf(all, std::vector{ObjectId{0}}), kSizes, light);
    BuiltPatches come =
        buildObjects(partOf(all, std::vector{ObjectId{1}, ObjectId{2}}), kSizes, {});
};

TEST_F(Additions, AreMeshedAsInTheWholeScene) {
    makeRoom(set.patches);
    const auto added = addObjects(set, come);
    ASSERT_TRUE(added);
    BuiltPatches whole = buildObjects(all, kSizes, {});
    const PatchSet &a = set.patches, &b = whole.patches;
    ASSERT_EQ(a.elements.size(), b.elements.size());
    EXPECT_DOUBLE_EQ(a.area, b.area);
    for (std::uint32_t o = 0; o < added->size(); ++o) {
        const ObjectPart &is = a.objects[(*added)[o].value], &should = b.objects[o + 1];
        EXPECT_EQ(is.path, should.path);
        EXPECT_FALSE(is.present) << "until it is posed";
        ASSERT_EQ(is.elements.count, should.elements.count);
        ASSERT_EQ(is.patches.count, should.patches.count);
        ASSERT_EQ(is.emitters.count, should.emitters.count);
        for (std::uint32_t i = 0; i < is.elements.count; ++i) {
            const Element &one = a.elements[is.elements.first + i],
                          &other = b.elements[should.elements.first + i];
            EXPECT_EQ(one.patch - is.patches.first, other.patch - should.patches.first);
            EXPECT_EQ(a.materials[one.material], b.materials[other.material]);
            for (std::size_t k = 0; k < 4; ++k)
                EXPECT_EQ(a.vertices[one.vertices[k]].receiver.position,
                          b.vertices[other.vertices[k]].receiver.position);
        }
        for (std::uint32_t i = 0; i < is.patches.count; ++i) {
            const Patch &one = a.patches[is.patches.first + i],
                        &other = b.patches[should.patches.first + i];
            EXPECT_EQ(one.centre, other.centre);
            EXPECT_EQ(a.nodes[one.centreNode].position, b.nodes[other.centreNode].position);
            EXPECT_EQ(a.corners[one.firstCorner], b.corners[other.firstCorner]);
            EXPECT_EQ(a.patchElements[one.firstElement] - is.elements.first,
                      b.patchElements[other.firstElement] - should.elements.first);
        }
    }
    EXPECT_EQ(set.emitterSources.size(), whole.emitterSources.size());
    EXPECT_EQ(a.emitters.back().object, added->back());
}

TEST_F(Additions, LeaveAllNumbersAsTheyWere) {
    makeRoom(set.patches);
    const PatchSet before = set.patches;
    ASSERT_TRUE(addObjects(set, come));
    const PatchSet& now = set.patches;
    EXPECT_EQ(now.vertices.size(), before.vertices.size());
    EXPECT_EQ(now.nodes.size(), before.nodes.size());
    EXPECT_EQ(now.patches.size(), before.patches.size());
    for (std::size_t e = 0; e < before.elements.size(); ++e)
        EXPECT_EQ(now.elements[e].vertices, before.elements[e].vertices);
    for (std::uint32_t v = 0; v < before.room.vertices.first; ++v)
        EXPECT_EQ(now.vertices[v].position, before.vertices[v].position);
}

TEST_F(Additions, ForWhichThereIsNoRoomChangeNothing) {
    const std::size_t objects = set.patches.objects.size(),
                      materials = set.patches.materials.size();
    EXPECT_FALSE(addObjects(set, come)) << "no room was made";
    EXPECT_EQ(set.patches.objects.size(), objects);
    EXPECT_EQ(set.patches.materials.size(), materials);
}

TEST_F(Additions, OfAMaterialThatIsThereHaveTheSame) {
    makeRoom(set.patches);
    const auto shared = paint(Rgb(0.3f));
    const auto boxOf = [&](const std::string& name) {
        const Scene more =
            sceneOf({object(name, boxData({1, 1, 1}, {1.2f, 1.2f, 1.2f}, false, shared))});
        return buildObjects(placeScene(more), kSizes, {});
    };
    BuiltPatches first = boxOf("first"), second = boxOf("second");
    ASSERT_TRUE(addObjects(set, first));
    const std::size_t materials = set.patches.materials.size();
    ASSERT_TRUE(addObjects(set, second));
    EXPECT_EQ(set.patches.materials.size(), materials);
}

} // namespace

} // namespace penumbra
