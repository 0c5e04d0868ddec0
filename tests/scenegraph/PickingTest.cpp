#include "scenegraph/Picking.h"

#include "RandomParts.h"
#include "SceneParts.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace penumbra {

namespace {

constexpr glm::vec3 kDown{0, 0, -1};

std::optional<Pick> pick(const Scene& scene, glm::vec3 origin, glm::vec3 direction) {
    return pick(placeScene(scene), origin, direction);
}

/// Path of what is met by a ray from (x, y, 10) straight down -Z, or "nothing".
std::string below(const Scene& scene, float x, float y) {
    const auto found = pick(scene, {x, y, 10}, kDown);
    return found ? found->path : "nothing";
}

TEST(Picking, FindsAPolygonFromBothSides) {
    const Scene scene = sceneOf({square("floor")});
    const auto above = pick(scene, {0.5f, 0.5f, 3}, kDown);
    ASSERT_TRUE(above);
    EXPECT_EQ(above->path, "/floor");
    EXPECT_EQ(above->object, ObjectId{0});
    EXPECT_FLOAT_EQ(above->distance, 3);
    EXPECT_EQ(above->position, glm::vec3(0.5f, 0.5f, 0));
    EXPECT_TRUE(pick(scene, {0.5f, 0.5f, -3}, -kDown));
}

TEST(Picking, PassesBesideAndLooksOnlyForward) {
    const Scene scene = sceneOf({square("floor")});
    EXPECT_EQ(below(scene, 1.5f, 0), "nothing");
    EXPECT_FALSE(pick(scene, {0, 0, 3}, -kDown));
    EXPECT_FALSE(pick(Scene(), {0, 0, 3}, kDown));
}

TEST(Picking, TheNearestWins) {
    const Scene scene = sceneOf({placed("low", moved(0, 0, 1), {square("mesh")}),
                                 placed("high", moved(0, 0, 3), {square("mesh")}),
                                 placed("middle", moved(0, 0, 2), {lamp("lamp")})});
    EXPECT_EQ(below(scene, 0, 0), "/high/mesh");
    const auto upwards = pick(scene, {0, 0, 1.5f}, -kDown);
    ASSERT_TRUE(upwards);
    EXPECT_EQ(upwards->path, "/middle/lamp");
}

TEST(Picking, KnowsTheShapesOfLights) {
    const Scene rect = sceneOf({lamp("lamp", RectShape{4, 2})});
    EXPECT_EQ(below(rect, 1.9f, 0.9f), "/lamp");
    EXPECT_EQ(below(rect, 0, 1.1f), "nothing");
    const Scene disk = sceneOf({lamp("lamp", DiskShape{1})});
    EXPECT_EQ(below(disk, 0.7f, 0.7f), "/lamp");
    EXPECT_EQ(below(disk, 0.8f, 0.8f), "nothing");
    const Scene sphere = sceneOf({lamp("lamp", SphereShape{2})});
    EXPECT_EQ(below(sphere, 0, 1.9f), "/lamp");
    EXPECT_EQ(below(sphere, 0, 2.1f), "nothing");
    EXPECT_FLOAT_EQ(pick(sphere, {0, 0, 10}, kDown)->distance, 8);
}

TEST(Picking, ARayInThePlaneOfALightMissesIt) {
    EXPECT_FALSE(pick(sceneOf({lamp("rect")}), {-5, 0, 0}, {1, 0, 0}));
    EXPECT_FALSE(pick(sceneOf({lamp("disk", DiskShape{})}), {-5, 0, 0}, {1, 0, 0}));
}

TEST(Picking, DistanceIsInMetresWhateverTheScaleAndTheLengthOfTheDirection) {
    const Scene scene = sceneOf({placed("small", scaled(0.01), {square("mesh")})});
    const auto found = pick(scene, {0, 0, 3}, 20.0f * kDown);
    ASSERT_TRUE(found);
    EXPECT_FLOAT_EQ(found->distance, 3);
    EXPECT_NEAR(found->position.z, 0, 1e-6);
    EXPECT_FALSE(pick(scene, {0.02f, 0, 3}, kDown)) << "the square is 2 cm wide";
}

TEST(Picking, TellsInstancesApart) {
    const auto chair = movable("chair", {square("seat")});
    const Scene scene = sceneOf(
        {placed("left", moved(-2, 0, 0), {chair}), placed("right", moved(2, 0, 0), {chair})});
    EXPECT_EQ(below(scene, -2, 0), "/left/chair/seat");
    EXPECT_EQ(below(scene, 2, 0), "/right/chair/seat");
    EXPECT_EQ(pick(scene, {2, 0, 10}, kDown)->object, ObjectId{1});
    EXPECT_EQ(below(scene, 0, 0), "nothing");
}

TEST(Picking, HiddenThingsAreTransparent) {
    const auto curtain = make<Switch>("curtain", {placed("up", moved(0, 0, 1), {square("mesh")})});
    const Scene scene = sceneOf({curtain, square("floor")});
    EXPECT_EQ(below(scene, 0, 0), "/curtain/up/mesh");
    curtain->setVisible(false);
    EXPECT_EQ(below(scene, 0, 0), "/floor");
}

TEST(Picking, AnObjectScaledToNothingIsNotMet) {
    EXPECT_EQ(below(sceneOf({placed("flat", scaled(0), {square("mesh"), lamp("lamp")})}), 0, 0),
              "nothing");
}

TEST(Picking, AConcaveFaceIsMetOnlyWhereItIs) {
    // An L whose fan from the first corner folds over the notch at the upper right, from every
    // start.
    std::vector<glm::vec3> corners{{0, 0, 0}, {2, 0, 0}, {2, 1, 0},
                                   {1, 1, 0}, {1, 2, 0}, {0, 2, 0}};
    for (std::size_t start = 0; start < corners.size(); ++start) {
        const Scene scene = sceneOf({polygon("floor", corners)});
        EXPECT_EQ(below(scene, 0.41f, 0.52f), "/floor") << start;
        EXPECT_EQ(below(scene, 1.61f, 0.52f), "/floor") << start;
        EXPECT_EQ(below(scene, 0.41f, 1.73f), "/floor") << start;
        EXPECT_EQ(below(scene, 1.23f, 1.34f), "nothing") << start;
        EXPECT_EQ(below(scene, 1.61f, 1.73f), "nothing") << start;
        std::rotate(corners.begin(), corners.begin() + 1, corners.end());
    }
}

TEST(Picking, AHoleOfASubdivisionSurfaceIsNotThere) {
    MeshData data = square("cage")->data();
    data.scheme = SubdivisionScheme::catmullClark;
    data.holes = {0};
    EXPECT_EQ(below(sceneOf({std::make_shared<Mesh>("cage", data)}), 0, 0), "nothing");
    data.scheme = SubdivisionScheme::none;
    EXPECT_EQ(below(sceneOf({std::make_shared<Mesh>("cage", data)}), 0, 0), "/cage");
}

RC_GTEST_PROP(Picking, ARayTowardsAPointOfAPlacedSquareFindsThatPoint, ()) {
    const glm::dmat4 matrix = frame();
    const glm::dvec4 inSquare(number(-0.99, 0.99), number(-0.99, 0.99), 0, 1);
    const auto target = glm::vec3(matrix * inSquare);
    const glm::vec3 origin = point(30);
    const glm::dvec4 originInSquare = glm::inverse(matrix) * glm::dvec4(origin, 1);
    RC_PRE(std::abs(originInSquare.z) > 0.1); // not edge-on
    const auto found =
        pick(sceneOf({placed("object", matrix, {square("mesh")})}), origin, target - origin);
    RC_ASSERT(found);
    RC_ASSERT(glm::length(found->position - target) < 1e-3f);
    RC_ASSERT(std::abs(found->distance - glm::length(target - origin)) < 1e-3f);
}

} // namespace

} // namespace penumbra
