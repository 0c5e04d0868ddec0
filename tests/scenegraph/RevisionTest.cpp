// A node's revision rises when the node is edited, and only then.
#include "SceneParts.h"
#include "scenegraph/LitGeometry.h"
#include "scenegraph/Objects.h"

#include <gtest/gtest.h>

namespace penumbra {

namespace {

/// Whether `edit` raises the revision of `node`.
template <class Edit>
bool raises(const Node& node, Edit edit) {
    const auto before = node.revision();
    edit();
    EXPECT_GE(node.revision(), before);
    return node.revision() > before;
}

TEST(Revision, OfAGroupRisesAsChildrenComeAndGo) {
    Group group("group");
    const NodePtr child = square("child");
    EXPECT_TRUE(raises(group, [&] { group.add(child); }));
    EXPECT_TRUE(raises(group, [&] { EXPECT_TRUE(group.remove(child)); }));
    EXPECT_FALSE(raises(group, [&] { EXPECT_FALSE(group.remove(child)); }));
}

TEST(Revision, OfAParentDoesNotFollowItsChildren) {
    const auto child = objectOf("child", {});
    const auto parent = make("parent", {child});
    EXPECT_FALSE(raises(*parent, [&] { child->setMatrix(moved(1, 0, 0)); }));
}

TEST(Revision, OfASwitchRisesWhenItTurns) {
    Switch lights("lights");
    EXPECT_FALSE(raises(lights, [&] { lights.setVisible(true); }));
    EXPECT_TRUE(raises(lights, [&] { lights.setVisible(false); }));
}

TEST(Revision, OfATransformRisesWhenItMoves) {
    Transform seat("seat");
    EXPECT_TRUE(raises(seat, [&] { seat.setMatrix(moved(1, 0, 0)); }));
    EXPECT_TRUE(raises(seat, [&] { seat.setBeginsObject(true); }));
    EXPECT_FALSE(raises(seat, [&] { seat.setBeginsObject(true); }));
}

TEST(Revision, OfALightRisesWhenItIsDimmed) {
    const auto source = light("key");
    EXPECT_TRUE(raises(*source, [&] { source->setLuminance(Rgb(50)); }));
}

TEST(Revision, OfACameraRisesWithItsLens) {
    Camera camera("eye", Lens());
    EXPECT_TRUE(raises(camera, [&] { camera.setLens(Lens()); }));
}

TEST(Revision, OfLitGeometryRisesWithNewLight) {
    LitMeshData data;
    data.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    data.indices = {0, 1, 2};
    data.triangleMaterial = {0};
    LitGeometry lit("lit", {0}, data);
    const std::vector<Rgb> light(3, Rgb(10));
    EXPECT_TRUE(raises(lit, [&] { lit.setIlluminance(light, light); }));
    EXPECT_EQ(lit.data().direct, light);
}

TEST(Revision, StaysWhenTheSceneIsOnlyRead) {
    const auto seat = objectOf("seat", {square("cushion")});
    const Scene scene = sceneOf({seat});
    EXPECT_FALSE(raises(*seat, [&] { placeScene(scene); }));
}

TEST(Group, RemovesOnlyTheFirstOccurrence) {
    const NodePtr chair = square("chair"), table = square("table");
    const auto group = make("row", {chair, table, chair});
    group->remove(chair);
    EXPECT_EQ(group->children(), (std::vector<NodePtr>{table, chair}));
}

} // namespace

} // namespace penumbra
