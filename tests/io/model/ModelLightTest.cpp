// Lights and cameras of models.
#include "io/model/ModelLight.h"

#include "tests/io/model/LayerParts.h"
#include "tests/io/usd/UsdTestFiles.h"
#include "tests/support/ModelTexts.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

namespace penumbra {

namespace {

using testing::ElementsAre;

constexpr double kPi = std::numbers::pi;

class ModelLights : public testing::Test {
protected:
    TemporaryFolder here;

    ImportedModel import(const std::string& nodes, const std::string& more) {
        return importModel(here.write("a.gltf", gltfText(nodes, more)));
    }
};

TEST_F(ModelLights, APointOfCandelasIsASphereThatLightsAsMuch) {
    // From afar a sphere of luminance L and radius r has the intensity I = L pi r^2.
    import(R"([{"children": [1, 2]}, {"mesh": 0}, {"name": "Bulb", "translation": [0, 2, 0], )" +
               gltfLight(0) + "}]",
           gltfLights(R"([{"type": "point", "color": [1, 0.5, 0.25], "intensity": 80}])"));
    const LoadedScene scene = loadUsdScene(here.file("a.gltf"));
    const auto nodes = nodesByPath(*scene.scene);
    const PlacedNode* bulb = leafOf(nodes, "/a/Node/Bulb");
    ASSERT_TRUE(bulb && bulb->light());
    const float radius = std::get<SphereShape>(bulb->light()->shape()).radius;
    EXPECT_FLOAT_EQ(radius, 0.05f);
    const double area = kPi * 0.05 * 0.05;
    EXPECT_NEAR(double(bulb->light()->luminance().r) * area, 80, 1e-3);
    EXPECT_NEAR(double(bulb->light()->luminance().g) * area, 40, 1e-3);
    EXPECT_NEAR(double(bulb->light()->luminance().b) * area, 20, 1e-3);
    EXPECT_EQ(glm::dvec3(bulb->toWorld[3]), glm::dvec3(0, 2, 0));
}

TEST_F(ModelLights, ASphereKeepsItsRadiusWhateverTheScaleAndTheUnit) {
    const std::string text = gltfText(
        R"([{"scale": [10, 10, 10], "children": [1]}, {"name": "Bulb", )" + gltfLight(0) + "}]",
        gltfLights(R"([{"type": "point"}])"));
    const auto model = importModel(here.write("a.gltf", text), {.metersPerUnit = 0.01});
    const auto radius = numbersOf(model.layer, "/a/Node/Bulb", "inputs:radius");
    ASSERT_EQ(radius.size(), 1u);
    EXPECT_NEAR(radius[0] * 10 * 0.01, 0.05, 1e-7); // [m]
}

TEST_F(ModelLights, OneLightOnSeveralNodesIsThereSeveralTimes) {
    const auto model =
        import(R"([{"children": [1, 2, 3]}, {"mesh": 0}, {"name": "A", )" + gltfLight(0) +
                   R"(}, {"name": "A", "translation": [1, 0, 0], )" + gltfLight(0) + "}]",
               gltfLights(R"([{"type": "point", "name": "L"}])"));
    EXPECT_EQ(model.lights, 2u);
    EXPECT_TRUE(primAt(model.layer, "/a/Node/A"));
    EXPECT_THAT(numbersOf(model.layer, "/a/Node/A_1", "xformOp:transform"),
                testing::Contains(1).Times(5));
}

TEST_F(ModelLights, ASpotKeepsItsConeAndLooksWhereItsNodeLooks) {
    const auto model =
        import(R"([{"children": [1, 2]}, {"mesh": 0}, {"name": "S", )" + gltfLight(0) + "}]",
               gltfLights(R"([{"type": "spot", "spot": {"outerConeAngle": 0.5}}])"));
    EXPECT_EQ(primAt(model.layer, "/a/Node/S")->typeName, "SphereLight");
    EXPECT_THAT(numbersOf(model.layer, "/a/Node/S", "inputs:shaping:cone:angle"),
                ElementsAre(testing::DoubleNear(0.5 * 180 / kPi, 1e-4)));
    EXPECT_TRUE(says(model, "spot light 'S'"));
    EXPECT_EQ(differenceAfterWriting(model.layer), "");
}

TEST_F(ModelLights, ADirectionalLightIsNamedAsLeftOut) {
    const auto model =
        import(R"([{"children": [1, 2]}, {"mesh": 0}, {"name": "Sun", )" + gltfLight(0) + "}]",
               gltfLights(R"([{"type": "directional"}])"));
    EXPECT_EQ(model.lights, 0u);
    EXPECT_TRUE(says(model, "light 'Sun' left out: directional"));
}

TEST_F(ModelLights, AnAreaLightIsARectangle) {
    ModelLight light;
    light.kind = ModelLight::Kind::rect;
    light.intensity = glm::dvec3(100); // [cd] along the normal: L A
    light.size = {2, 0.5};
    light.direction = {0, -1, 0};
    Diagnostics diagnostics;
    const auto spec = lightPrim(light, "R", glm::dmat4(1), 1, {"a"}, diagnostics);
    ASSERT_TRUE(spec);
    EXPECT_EQ(spec->typeName, "RectLight");
    EXPECT_THAT(spec->property("inputs:intensity")->value.numbers(), ElementsAre(100));
    const auto m = spec->property("xformOp:transform")->value.numbers();
    EXPECT_THAT((std::vector<double>{m[8], m[9], m[10]}), ElementsAre(0, 1, 0)); // +Z looks back
}

TEST_F(ModelLights, ACameraSeesWhatItSawAndStandsWhereItStood) {
    import(R"([{"children": [1, 2]}, {"mesh": 0},
               {"name": "Eye", "translation": [1, 2, 3], "camera": 0}])",
           R"(, "cameras": [{"type": "perspective", "perspective":
              {"yfov": 0.8, "aspectRatio": 1.5, "znear": 0.1, "zfar": 50}}])");
    const LoadedScene scene = loadUsdScene(here.file("a.gltf"));
    const auto nodes = nodesByPath(*scene.scene);
    const PlacedNode* eye = leafOf(nodes, "/a/Node/Eye");
    ASSERT_TRUE(eye && eye->camera());
    const Lens& lens = eye->camera()->lens();
    EXPECT_NEAR(2 * std::atan(lens.verticalAperture / (2 * lens.focalLength)), 0.8, 1e-6);
    EXPECT_NEAR(lens.horizontalAperture / lens.verticalAperture, 1.5, 1e-6);
    EXPECT_FLOAT_EQ(lens.clippingRange.x, 0.1f);
    EXPECT_FLOAT_EQ(lens.clippingRange.y, 50);
    EXPECT_EQ(glm::dvec3(eye->toWorld[3]), glm::dvec3(1, 2, 3)); // Assimp says it twice
}

TEST_F(ModelLights, ACameraWithoutAFarPlaneStillHasItsNearOne) {
    const auto model = import(R"([{"children": [1, 2]}, {"mesh": 0}, {"name": "E", "camera": 0}])",
                              R"(, "cameras": [{"type": "perspective", "perspective":
                                 {"yfov": 0.8, "znear": 0.01}}])");
    const auto range = numbersOf(model.layer, "/a/Node/E", "clippingRange");
    ASSERT_EQ(range.size(), 2u);
    EXPECT_FLOAT_EQ(float(range[0]), 0.01f);
    EXPECT_GE(range[1], 1000);
}

} // namespace

} // namespace penumbra
