// What is selected, and where it is to be.
#include "viewer/input/Selection.h"

#include "tests/scenegraph/SceneParts.h"

#include <gtest/gtest.h>

namespace penumbra {

namespace {

TEST(Selection, IsTheObjectWithItsNodeItsPaintAndItsLights) {
    const auto bulb = light("Bulb");
    const auto desk = objectOf("Desk", {square("Top"), make("Lamp", {bulb})});
    desk->setMatrix(glm::translate(glm::dmat4(1.0), {0, 0, 1}));
    bulb->setLuminance(Rgb(5));
    Scene scene;
    scene.root->add(desk);
    scene.root->add(square("Floor"));
    const PlacedScene placed = placeScene(scene);
    const SceneRays rays(placed);
    // the light lies in the desk's top: aim beside it
    const auto touch = rays.touch({0.9, 0.9, 3}, {0, 0, -1}, 10);
    ASSERT_TRUE(touch);
    const Selection selection = selectionOf(scene, placed, *touch);
    EXPECT_EQ(selection.objectPath, "/Desk");
    EXPECT_EQ(selection.path, "/Desk/Top");
    EXPECT_EQ(selection.node, desk);
    EXPECT_TRUE(selection.emits());
    ASSERT_EQ(selection.lights.size(), 1u);
    EXPECT_EQ(selection.lights[0], bulb);
    const auto below = rays.touch({0.9, 0.9, 0.5}, {0, 0, -1}, 10);
    ASSERT_TRUE(below);
    const Selection floor = selectionOf(scene, placed, *below);
    EXPECT_FALSE(floor.emits());
    EXPECT_EQ(floor.node, nullptr);
    EXPECT_EQ(floor.material->name(), "paint");
}

TEST(Selection, EveryLightIsListedOnceThoughItHangsInManyPlaces) {
    const auto bulb = light("Bulb");
    Scene scene;
    scene.root->add(make("a", {bulb}));
    scene.root->add(make("b", {bulb}));
    scene.root->add(light("other"));
    EXPECT_EQ(allLights(scene, placeScene(scene)).size(), 2u);
}

TEST(Selection, AMatrixPutsItsObjectWhereItIsWantedBelowAnyParents) {
    const glm::dmat4 parent =
        glm::scale(glm::rotate(glm::dmat4(1.0), 0.7, glm::dvec3(0, 1, 0)), glm::dvec3(0.01));
    Transform node("seat");
    node.setMatrix(glm::rotate(glm::translate(glm::dmat4(1.0), {300, 20, 10}), 0.3, {0, 0, 1}));
    const glm::dmat4 now = parent * node.matrix();
    glm::dmat4 shifted = now;
    shifted[3] += glm::dvec4(1, 2, 3, 0);
    const glm::dmat4 slid = matrixFor(node, now, shifted);
    EXPECT_EQ(glm::dmat3(slid), glm::dmat3(node.matrix())) << "bit for bit";
    const glm::dmat4 turned = glm::rotate(glm::dmat4(1.0), 0.5, glm::dvec3(0, 0, 1)) * now;
    for (const auto& [matrix, wanted] :
         {std::pair(slid, shifted), std::pair(matrixFor(node, now, turned), turned)})
        for (int column = 0; column < 4; ++column)
            EXPECT_LT(glm::distance((parent * matrix)[column], wanted[column]), 1e-9);
}

} // namespace

} // namespace penumbra
