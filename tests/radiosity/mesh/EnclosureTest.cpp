// Lights that get into closed things and out of them.
#include "radiosity/mesh/Enclosure.h"
#include "tests/support/Scenes.h"

#include <gtest/gtest.h>

namespace penumbra {

namespace {

constexpr MeshingOptions kCoarse{.patchSize = 0.5f, .elementSize = 0.25f};

NodePtr twoSidedBox() {
    MeshData data = boxData(glm::vec3(-0.3f), glm::vec3(0.3f), false);
    data.doubleSided = true;
    return std::make_shared<Mesh>("mesh", std::move(data));
}

/// A light and a closed box in a room; both can be moved.
struct BoxAndLight {
    std::shared_ptr<Transform> box = objectOf("box", {twoSidedBox()});
    std::shared_ptr<Transform> light =
        objectOf("lamp", {std::make_shared<Light>("light", RectShape{0.2f, 0.2f}, Rgb(10))});
    Scene scene = sceneOf({object("room", boxData({-2, -2, -2}, {2, 2, 2}, true)), box, light});

    BoxAndLight() {
        box->setMatrix(moved(1, 0, 0));
        light->setMatrix(moved(-1, 0, 0));
    }
};

/// How many closed surfaces hold a light.
std::size_t litCount(const LitScene& lit, const Scene& scene) {
    const BuiltPatches built = buildPatches(placeScene(scene), sizesOf(lit.patches()));
    return built.enclosures.litCount();
}

TEST(Enclosure, ALightInABoxLightsItFromWithin) {
    BoxAndLight things;
    const LitScene outside(placeScene(things.scene), kCoarse, {.directOnly = true});
    EXPECT_EQ(litCount(outside, things.scene), 1u) << "the room";
    things.light->setMatrix(moved(1, 0, 0.1));
    EXPECT_EQ(litCount(outside, things.scene), 2u) << "the room and the box";
    const LitScene inside(placeScene(things.scene), sizesOf(outside.patches()), {});
    EXPECT_GT(inside.patches().patchCount(), outside.patches().patchCount())
        << "the inside of the box is lit and drawn";
}

TEST(Enclosure, ABoxAloneIsMeshedAnewWhenALightGetsIntoItOrItOverALight) {
    for (const bool lightMoves : {true, false}) {
        BoxAndLight things;
        LitScene lit(placeScene(things.scene), kCoarse, {.directOnly = true});
        const std::size_t outside = lit.patches().patchCount();
        const auto follow = [&](bool adds) {
            const LitScene::Followed followed = lit.follow(placeScene(things.scene));
            EXPECT_FALSE(followed.rebuilt);
            EXPECT_EQ(followed.added, adds);
        };
        Transform& moves = lightMoves ? *things.light : *things.box;
        moves.setMatrix(moved(0, 0, 1)); // past nothing
        follow(false);
        moves.setMatrix(lightMoves ? things.box->matrix() : things.light->matrix());
        follow(true);
        EXPECT_GT(lit.patches().patchCount(), outside);
        moves.setMatrix(moved(0, 0, 1));
        follow(true); // taken out again
        EXPECT_EQ(lit.patches().patchCount(), outside);
    }
}

TEST(Enclosure, ALightAndTheBoxAroundItAreMovedTogetherWithoutMeshing) {
    BoxAndLight things;
    things.light->setMatrix(things.box->matrix());
    LitScene lit(placeScene(things.scene), kCoarse, {.directOnly = true});
    for (Transform* thing : {things.light.get(), things.box.get()})
        thing->setMatrix(moved(0, 0.3, 0) * thing->matrix());
    EXPECT_FALSE(lit.follow(placeScene(things.scene)).rebuilt);
}

TEST(Enclosure, ABoxAroundAMeshThatShinesIsSolidWhileThatIsDark) {
    BoxAndLight things;
    const auto glow = paint(Rgb(0.5f), Rgb(5));
    const auto ball = objectOf(
        "ball",
        {std::make_shared<Mesh>("mesh", boxData(glm::vec3(-0.1f), glm::vec3(0.1f), false, glow))});
    ball->setMatrix(things.box->matrix());
    things.scene.root->add(ball);
    LitScene lit(placeScene(things.scene), kCoarse, {.directOnly = true});
    const std::size_t lightInside = lit.patches().patchCount();
    for (const float emission : {0.0f, 5.0f, 0.0f}) {
        glow->setEmission(Rgb(emission));
        EXPECT_FALSE(lit.follow(placeScene(things.scene)).rebuilt);
        const LitScene scratch(placeScene(things.scene), sizesOf(lit.patches()),
                               {.directOnly = true});
        EXPECT_EQ(lit.patches().patchCount(), scratch.patches().patchCount());
        EXPECT_EQ(lit.patches().patchCount() < lightInside, emission == 0);
    }
}

TEST(Enclosure, ADarkLightInABoxCountsAsWell) {
    BoxAndLight things;
    std::dynamic_pointer_cast<Light>(things.light->children()[0])->setLuminance(Rgb());
    things.light->setMatrix(things.box->matrix());
    const LitScene lit(placeScene(things.scene), kCoarse, {.directOnly = true});
    EXPECT_EQ(litCount(lit, things.scene), 2u) << "it may be switched on, which is to cost no ray";
}

} // namespace

} // namespace penumbra
