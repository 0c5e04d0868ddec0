// Why it is dark here, asked while walking.
#include "radiosity/query/LightProbe.h"

#include "tests/scenegraph/SceneParts.h"

#include <gtest/gtest.h>

#include <cmath>

namespace penumbra {

namespace {

/// A square floor, a square light of 1 m^2 and 100 nit at 2 m, facing down, a board between them.
struct DarkPlace {
    explicit DarkPlace(glm::dvec3 boardAt) {
        board->setMatrix(glm::scale(glm::translate(glm::dmat4(1.0), boardAt), glm::dvec3(0.25)));
        scene.root->add(square("floor"));
        scene.root->add(board);
        scene.root->add(
            placed("hook", glm::translate(glm::dmat4(1.0), {0, 0, 2}), {light("lamp")}));
        scene.root->add(
            placed("side", glm::translate(glm::dmat4(1.0), {0, 0, -2}), {light("off")}));
    }
    std::vector<EmitterAccount> probe(glm::dvec3 at) const {
        const PlacedScene all = placeScene(scene);
        return probeLight(all, SceneRays(all), at, {0, 0, 1});
    }
    std::shared_ptr<Transform> board = objectOf("board", {square("top")});
    Scene scene;
};

TEST(LightProbe, UnderAFreeLightAllOfItsClosedFormArrives) {
    // A square of side 1 seen from 2 m below its middle: four times Howell's C-3 with a = 0.25,
    // F = 2/pi a/sqrt(1+a^2) atan(a/sqrt(1+a^2)) a quarter.
    const double a = 0.25, root = std::sqrt(1 + a * a);
    const double factor = 4 / M_PI * a / root * std::atan(a / root);
    const auto sources = DarkPlace({5, 0, 1}).probe({0, 0, 0});
    ASSERT_EQ(sources.size(), 2u);
    EXPECT_EQ(sources[0].path, "/hook/lamp");
    EXPECT_NEAR(sources[0].unoccluded.g, M_PI * 100 * factor, 0.02);
    EXPECT_EQ(sources[0].arrives, sources[0].unoccluded);
    EXPECT_TRUE(sources[0].losses.empty());
    EXPECT_EQ(sources[1].unoccluded, Rgb()) << "below the floor";
}

TEST(LightProbe, NamesWhoStandsInTheLight) {
    const DarkPlace place({0, 0, 1}); // hides all of a light of 1 m at 2 m
    const auto sources = place.probe({0, 0, 0});
    EXPECT_EQ(sources[0].arrives, Rgb());
    ASSERT_EQ(sources[0].losses.size(), 1u);
    EXPECT_EQ(placeScene(place.scene).objects[sources[0].losses[0].object.value].path, "/board");
    EXPECT_NEAR(sources[0].losses[0].lux.g, sources[0].unoccluded.g, 1e-4f);
}

TEST(LightProbe, InThePenumbraPartArrivesAndTheAccountAddsUp) {
    const auto sources = DarkPlace({0.25, 0, 1}).probe({0, 0, 0}); // half of it
    EXPECT_NEAR(sources[0].arrives.g / sources[0].unoccluded.g, 0.5, 0.05);
    EXPECT_NEAR(sources[0].arrives.g + sources[0].losses.at(0).lux.g, sources[0].unoccluded.g,
                1e-3f);
}

} // namespace

} // namespace penumbra
