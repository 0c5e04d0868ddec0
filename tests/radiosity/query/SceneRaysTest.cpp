// What rays meet of a scene.
#include "radiosity/query/SceneRays.h"

#include "tests/scenegraph/SceneParts.h"

#include <gtest/gtest.h>

#include <cmath>

namespace penumbra {

namespace {

/// A square floor, a square a metre above it, a light that faces down two metres above.
struct Room {
    Room() {
        const auto up = [](double z) { return glm::translate(glm::dmat4(1.0), {0, 0, z}); };
        seat->setMatrix(up(1));
        scene.root->add(square("floor"));
        scene.root->add(seat);
        scene.root->add(placed("hook", up(2), {light("lamp")}));
    }
    std::optional<Touch> down(double from, ObjectId except = {}) const {
        return SceneRays(placeScene(scene)).touch({0.2, 0.1, from}, {0, 0, -2}, 100, except);
    }
    std::shared_ptr<Transform> seat = objectOf("seat", {square("cushion")});
    Scene scene;
};

TEST(SceneRays, TellTheNearestSurfaceWhatItIsAndWhichWayItFaces) {
    const Room room;
    const auto light = room.down(5);
    ASSERT_TRUE(light);
    EXPECT_EQ(light->path, "/hook/lamp");
    EXPECT_NE(light->light, nullptr);
    EXPECT_EQ(light->material, nullptr);
    const auto seat = room.down(1.5);
    ASSERT_TRUE(seat);
    EXPECT_EQ(seat->path, "/seat/cushion");
    EXPECT_EQ(seat->material->name(), "paint");
    EXPECT_NEAR(seat->distance, 0.5, 1e-6);
    EXPECT_LT(glm::distance(seat->position, glm::dvec3(0.2, 0.1, 1)), 1e-6);
    EXPECT_LT(glm::distance(seat->normal, glm::dvec3(0, 0, 1)), 1e-6);
}

TEST(SceneRays, LookThroughAnObjectOnRequest) {
    const Room room;
    const auto seat = room.down(1.5);
    ASSERT_TRUE(seat);
    const auto floor = room.down(1.5, seat->object);
    ASSERT_TRUE(floor);
    EXPECT_EQ(floor->path, "/floor");
}

TEST(SceneRays, SeeThroughTheBacksThatAreNotDrawn) {
    Room room;
    const auto seenUp = [&] {
        const auto seen = SceneRays(placeScene(room.scene)).seen({0.2, 0.1, 0.5}, {0, 0, 1}, 100);
        return seen ? seen->path : std::string();
    };
    EXPECT_EQ(seenUp(), "/hook/lamp") << "the seat's back is not in the way";
    room.seat->setMatrix(room.seat->matrix() *
                         glm::rotate(glm::dmat4(1.0), glm::pi<double>(), {1, 0, 0}));
    EXPECT_EQ(seenUp(), "/seat/cushion") << "it has been turned over";
    room.seat->setMatrix(room.seat->matrix() * glm::scale(glm::dmat4(1.0), {-1, 1, 1}));
    EXPECT_EQ(seenUp(), "/seat/cushion") << "mirrored, its front is its front";
}

TEST(SceneRays, PassByPointsThatAreNowhere) {
    for (const float nowhere : {1e30f, std::nanf("")}) {
        Room room;
        room.scene.root->add(polygon("torn", {{0, 0, 3}, {1, 0, 3}, {nowhere, 1, 3}}));
        PlacedScene scene = placeScene(room.scene);
        scene.bounds = {glm::vec3(-1), glm::vec3(2)};
        const auto touch = SceneRays(scene).touch({0.2, 0.1, 1.5}, {0, 0, -1}, 100);
        ASSERT_TRUE(touch);
        EXPECT_EQ(touch->path, "/seat/cushion");
    }
}

TEST(SceneRays, FollowWhatIsMovedHiddenAndAdded) {
    Room room;
    const auto visibility = make<Switch>("choice", {objectOf("box", {square("lid")})});
    room.scene.root->add(visibility);
    SceneRays rays(placeScene(room.scene));
    const auto pathBelow = [&](double z) {
        const auto touch = rays.touch({0, 0, z}, {0, 0, -1}, 100);
        return touch ? touch->path : "";
    };
    room.seat->setMatrix(glm::translate(glm::dmat4(1.0), {0, 0, 0.5}));
    rays.follow(placeScene(room.scene));
    EXPECT_TRUE(rays.touch({0, 0, 1}, {0, 0, -1}, 0.6)) << "the seat came down";
    EXPECT_NEAR(rays.bounds(rays.touch({0, 0, 1}, {0, 0, -1}, 0.6)->object).lower.z, 0.5f, 1e-6f);
    visibility->setVisible(false);
    room.seat->setMatrix(glm::translate(glm::dmat4(1.0), {5, 0, 0.5}));
    rays.follow(placeScene(room.scene));
    EXPECT_EQ(pathBelow(1), "/floor");
    room.scene.root->add(
        placed("shelf", glm::translate(glm::dmat4(1.0), {0, 0, 0.2}), {square("board")}));
    rays.follow(placeScene(room.scene));
    EXPECT_EQ(pathBelow(1), "/shelf/board");
}

TEST(SceneRays, AreWhatStopsAWalker) {
    const Room room;
    const SceneRays rays(placeScene(room.scene));
    const auto floor = rays.ahead({0.9, 0.9, 0.4}, {0, 0, -1}, 10);
    ASSERT_TRUE(floor);
    EXPECT_NEAR(floor->distance, 0.4, 1e-6);
    EXPECT_FALSE(rays.ahead({0.9, 0.9, 0.4}, {0, 0, -1}, 0.3));
}

} // namespace

} // namespace penumbra
