// Which pieces of a scene belong to one rigid object.
#include "scenegraph/Objects.h"

#include "SceneParts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace penumbra {

namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<std::string> objectPaths(const PlacedScene& scene) {
    std::vector<std::string> paths;
    for (const Object& object : scene.objects) paths.push_back(object.path);
    return paths;
}

/// The object that each mesh belongs to, in the order of the meshes.
std::vector<std::string> ownersOfMeshes(const PlacedScene& scene) {
    std::vector<std::string> owners;
    for (const auto& mesh : scene.meshes)
        owners.push_back(scene.objects.at(mesh.object.value).path);
    return owners;
}

TEST(Objects, WhatStandsBesideAllTransformsBelongsToTheRoot) {
    const PlacedScene scene =
        placeScene(sceneOf({square("floor"), make("group", {square("wall")})}));
    EXPECT_THAT(ownersOfMeshes(scene), ElementsAre("/", "/"));
    EXPECT_EQ(scene.objects.at(0).toWorld, glm::dmat4(1.0));
}

TEST(Objects, ATransformThatDirectlyHoldsGeometryBeginsAnObject) {
    const PlacedScene scene =
        placeScene(sceneOf({placed("table", moved(1, 0, 0), {square("top")}),
                            placed("lamp", moved(0, 3, 0), {light("bulb")}),
                            placed("shelf", moved(2, 0, 0), {make("boards", {square("board")})})}));
    EXPECT_THAT(objectPaths(scene), ElementsAre("/table", "/lamp", "/shelf"));
    EXPECT_EQ(scene.objects.at(0).toWorld, moved(1, 0, 0));
    EXPECT_EQ(scene.lights.at(0).object, ObjectId{1});
}

TEST(Objects, ATransformThatHoldsOnlyTransformsBeginsNone) {
    const PlacedScene scene =
        placeScene(sceneOf({placed("room", moved(5, 0, 0),
                                   {placed("a", moved(1, 0, 0), {square("mesh")}),
                                    placed("b", moved(2, 0, 0), {square("mesh")})})}));
    EXPECT_THAT(objectPaths(scene), ElementsAre("/room/a", "/room/b"));
    EXPECT_EQ(scene.objects.at(1).toWorld, moved(7, 0, 0));
}

TEST(Objects, ATransformThatSaysSoBeginsOneWhateverItHolds) {
    const PlacedScene scene = placeScene(
        sceneOf({objectOf("seat", {placed("part", moved(1, 0, 0), {square("cushion")}),
                                   placed("part2", moved(2, 0, 0), {square("back")})})}));
    EXPECT_THAT(ownersOfMeshes(scene), ElementsAre("/seat", "/seat"));
    EXPECT_EQ(scene.meshes.at(1).toWorld, moved(2, 0, 0));
}

TEST(Objects, InsideAnObjectOnlyATransformThatSaysSoBeginsAnother) {
    const PlacedScene scene = placeScene(sceneOf({placed(
        "desk", moved(0, 0, 0),
        {square("top"), placed("leg", moved(1, 0, 0), {square("leg")}),
         objectOf("drawer", {square("front"), placed("knob", moved(0, 0, 1), {square("knob")})}),
         square("back")})}));
    EXPECT_THAT(ownersOfMeshes(scene),
                ElementsAre("/desk", "/desk", "/desk/drawer", "/desk/drawer", "/desk"));
}

TEST(Objects, AfterAnObjectTheRootGoesOn) {
    const PlacedScene scene =
        placeScene(sceneOf({objectOf("seat", {square("cushion")}), square("floor")}));
    EXPECT_THAT(ownersOfMeshes(scene), ElementsAre("/seat", "/"));
}

TEST(Objects, WithoutGeometryAreNotListed) {
    const PlacedScene scene = placeScene(
        sceneOf({objectOf("empty", {}), make("group", {}), objectOf("seat", {square("mesh")})}));
    EXPECT_THAT(objectPaths(scene), ElementsAre("/seat"));
}

TEST(Objects, HiddenThingsAreNotPlaced) {
    const auto off = make<Switch>("off", {square("mesh"), light("lamp")});
    off->setVisible(false);
    const PlacedScene scene = placeScene(sceneOf({placed("object", moved(0, 0, 0), {off})}));
    EXPECT_THAT(scene.objects, IsEmpty());
    EXPECT_THAT(scene.meshes, IsEmpty());
    EXPECT_THAT(scene.lights, IsEmpty());
    EXPECT_TRUE(scene.bounds.empty());
}

TEST(Objects, AnInstanceIsAnObjectInEachOfItsPlaces) {
    const auto chair = objectOf("chair", {square("seat")});
    const PlacedScene scene = placeScene(sceneOf(
        {placed("left", moved(-1, 0, 0), {chair}), placed("right", moved(1, 0, 0), {chair})}));
    EXPECT_THAT(objectPaths(scene), ElementsAre("/left/chair", "/right/chair"));
    EXPECT_EQ(scene.meshes.at(0).node, scene.meshes.at(1).node);
    EXPECT_EQ(scene.objects.at(1).toWorld, moved(1, 0, 0));
}

TEST(Objects, CamerasAreListedWithTheirPlace) {
    const auto camera = std::make_shared<Camera>("camera", Lens());
    const PlacedScene scene = placeScene(sceneOf({placed("tripod", moved(0, 2, 0), {camera})}));
    ASSERT_EQ(scene.cameras.size(), 1u);
    EXPECT_EQ(scene.cameras.at(0).path, "/tripod/camera");
    EXPECT_EQ(scene.cameras.at(0).toWorld, moved(0, 2, 0));
    EXPECT_FALSE(scene.cameras.at(0).object.valid()) << "a tripod without geometry is no object";
}

TEST(Objects, BoundsHoldMeshesAndLightsInTheWorld) {
    const PlacedScene scene =
        placeScene(sceneOf({placed("table", moved(10, 0, 0), {square("top")}),
                            placed("lamp", moved(0, 5, 0), {light("bulb", SphereShape{0.5f})})}));
    EXPECT_EQ(scene.bounds.lower, glm::vec3(-0.5f, -1, -0.5f));
    EXPECT_EQ(scene.bounds.upper, glm::vec3(11, 5.5f, 0.5f));
}

} // namespace

} // namespace penumbra
