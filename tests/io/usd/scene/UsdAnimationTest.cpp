#include "tests/io/usd/UsdTestFiles.h"

#include "scenegraph/Objects.h"
#include "scenegraph/Transform.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace penumbra {

TEST(UsdAnimation, AStillSceneHasNone) {
    EXPECT_FALSE(loadText("def Cube \"c\"\n{\n}\n").animation);
}

TEST(UsdAnimation, SizesOfShapesAreHeldWithAWord) {
    const LoadedScene loaded = loadText("def Sphere \"ball\"\n{\n"
                                        "    double radius.timeSamples = { 0: 1, 10: 2 }\n}\n"
                                        "def RectLight \"holds\"\n{\n"
                                        "    float inputs:width.timeSamples = { 0: 1, 10: 2 }\n"
                                        "    def Cube \"another\"\n    {\n    }\n}\n");
    EXPECT_EQ(countOf(loaded, "an animated size is held"), 2u);
}

namespace {

/// Of a light's shape [local units].
glm::dvec3 sizeOf(const PlacedNode& light) {
    return light.light()->bounds().size();
}

/// A side of a light: along its axis `k`, as long as it is that way [m, world].
glm::dvec3 sideOf(const PlacedNode& light, int k) {
    return sizeOf(light)[k] * glm::dvec3(light.toWorld[k]);
}

} // namespace

TEST(UsdAnimation, LightsAreResized) {
    const std::string text = R"((metersPerUnit = 1)
def RectLight "panel"
{
    float inputs:width.timeSamples = { 0: 1, 10: 2 }
    float inputs:height.timeSamples = { 0: 1, 10: 0.5 }
    float inputs:intensity = 100
    bool inputs:normalize = 1
    double3 xformOp:scale = (3, 1, 1)
    uniform token[] xformOpOrder = ["xformOp:scale"]
}
def DiskLight "disk"
{
    float inputs:radius.timeSamples = { 0: 0.5, 10: 0.25 }
}
def SphereLight "ball"
{
    float inputs:radius.timeSamples = { 0: 0.5, 10: 0, 20: 1 }
}
)";
    const LoadedScene played = loadText(text);
    EXPECT_EQ(countOf(played, "an animated size is held"), 0u);
    EXPECT_EQ(countOf(played, "a light without area left out"), 1u) << "the ball, at 10";
    const auto expectExtents = [&](const char* path, glm::dvec3 expected) {
        const PlacedNode light = nodesByPath(*played.scene).at(path);
        for (int k = 0; k < 3; ++k)
            EXPECT_NEAR(glm::length(sideOf(light, k)), expected[k], 1e-6) << path;
    };
    expectExtents("/panel", {3, 1, 0});
    played.animation->setTime(10);
    expectExtents("/panel", {6, 0.5, 0});
    expectExtents("/disk", {0.5, 0.5, 0});
    expectExtents("/ball", {0, 0, 0});
    const auto panel = nodesByPath(*played.scene).at("/panel");
    EXPECT_NEAR(panel.light()->luminance().r, 100 / 3.0, 1e-4) << "its flux is that of before";
    played.animation->setTime(20);
    expectExtents("/ball", {2, 2, 2});
    played.animation->setTime(0);
    expectExtents("/panel", {3, 1, 0});
}

TEST(UsdAnimation, PlayingEditsOnlyWhatChanges) {
    const LoadedScene loaded = loadText(R"((metersPerUnit = 1
    startTimeCode = 0)
def Xform "goes"
{
    double3 xformOp:translate.timeSamples = { 0: (0, 0, 0), 10: (10, 0, 0) }
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
def Xform "stays"
{
    double3 xformOp:translate = (1, 1, 1)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
def RectLight "lamp"
{
    float inputs:intensity.timeSamples = { 0: 100, 10: 200 }
}
def CylinderLight "tube"
{
    float inputs:intensity.timeSamples = { 0: 1, 10: 2 }
}
def Camera "eye"
{
    float focalLength.timeSamples = { 0: 50, 10: 100 }
}
def Cube "painted"
{
    rel material:binding = </M>
}
def Material "M"
{
    token outputs:surface.connect = </M/S.outputs:surface>
    def Shader "S"
    {
        uniform token info:id = "UsdPreviewSurface"
        color3f inputs:diffuseColor.timeSamples = { 0: (0, 0, 0), 10: (0.5, 0.5, 0.5) }
    }
}
)");
    ASSERT_TRUE(loaded.animation);
    const auto nodes = nodesByPath(*loaded.scene);
    const auto& goes = dynamic_cast<const Transform&>(*nodes.at("/goes").node);
    const auto& stays = *nodes.at("/stays").node;
    const Light& light = *nodes.at("/lamp").light();
    const Material& tube = *nodes.at("/tube").mesh()->data().materials.at(0);
    const Material& paint = *nodes.at("/painted").mesh()->data().materials.at(0);
    const std::uint64_t before = goes.revision();

    loaded.animation->setTime(0); // where it is already
    EXPECT_EQ(goes.revision(), before);
    EXPECT_EQ(light.revision(), 1u);

    const std::uint64_t still = stays.revision();
    loaded.animation->setTime(5);
    EXPECT_EQ(goes.matrix()[3].x, 5);
    EXPECT_GT(goes.revision(), before);
    EXPECT_EQ(stays.revision(), still);
    EXPECT_EQ(light.luminance(), Rgb(150));
    EXPECT_EQ(tube.emission(), Rgb(1.5f));
    EXPECT_EQ(nodes.at("/eye").camera()->lens().focalLength, 75);
    EXPECT_EQ(paint.reflectance(), Rgb(0.25f));
}

const char* const kComesAndGoes = R"((metersPerUnit = 1
    startTimeCode = 0)
def Xform "room"
{
    def Cube "box"
    {
        token visibility.timeSamples = { 0: "invisible", 3: "inherited", 6: "invisible" }
    }
    def Xform "seat"
    {
        token visibility.timeSamples = { 0: "inherited", 3: "invisible" }
        double3 xformOp:translate = (1, 2, 3)
        uniform token[] xformOpOrder = ["xformOp:translate"]
        def Cube "part"
        {
        }
        def Xform "drawer"
        {
            double3 xformOp:translate.timeSamples = { 0: (0, 0, 0), 3: (1, 0, 0) }
            uniform token[] xformOpOrder = ["xformOp:translate"]
            def RectLight "lamp"
            {
            }
        }
    }
    def Cube "stays"
    {
    }
}
)";

/// Paths of the objects, hidden ones in brackets.
std::vector<std::string> objectsIn(const Scene& scene) {
    std::vector<std::string> paths;
    for (const Object& object : placeScene(scene).objects)
        paths.push_back(object.visible ? object.path : "(" + object.path + ")");
    return paths;
}

TEST(UsdAnimation, WhatComesAndGoesIsAnObjectThatIsHiddenAndShown) {
    using testing::ElementsAre;
    const LoadedScene loaded = loadText(kComesAndGoes);
    ASSERT_TRUE(loaded.animation);
    EXPECT_TRUE(loaded.diagnostics.empty());
    const Scene& scene = *loaded.scene;
    EXPECT_THAT(objectsIn(scene),
                ElementsAre("(/room/box)", "/room/seat", "/room/seat/drawer", "/room"));
    loaded.animation->setTime(3);
    EXPECT_THAT(objectsIn(scene),
                ElementsAre("/room/box", "(/room/seat)", "(/room/seat/drawer)", "/room"));
    loaded.animation->setTime(7); // held between the samples and behind them
    EXPECT_THAT(objectsIn(scene),
                ElementsAre("(/room/box)", "(/room/seat)", "(/room/seat/drawer)", "/room"));
    loaded.animation->setTime(2.9);
    EXPECT_THAT(objectsIn(scene),
                ElementsAre("(/room/box)", "/room/seat", "/room/seat/drawer", "/room"));
    EXPECT_EQ(nodesByPath(scene).at("/room/seat").toWorld[3], glm::dvec4(1, 2, 3, 1));
}

TEST(UsdAnimation, ASwitchIsEditedOnlyWhenItTurns) {
    const LoadedScene loaded = loadText(kComesAndGoes);
    const NodePtr room = loaded.scene->root->children().at(0);
    const NodePtr box = dynamic_cast<const Group&>(*room).children().at(0);
    ASSERT_EQ(box->name(), "box");
    const std::uint64_t before = box->revision();
    loaded.animation->setTime(1);
    EXPECT_EQ(box->revision(), before);
    loaded.animation->setTime(3);
    const std::uint64_t shown = box->revision();
    EXPECT_GT(shown, before);
    loaded.animation->setTime(5);
    EXPECT_EQ(box->revision(), shown);
}

TEST(UsdAnimation, APrimThatIsAlwaysHiddenIsLeftOutAndOthersKeepTheirPaths) {
    const LoadedScene loaded = loadText(R"(def Xform "gone"
{
    token visibility = "invisible"
    def Cube "c"
    {
        token visibility.timeSamples = { 0: "invisible", 3: "inherited" }
    }
}
def Xform "here"
{
    token visibility = "inherited"
    def Cube "c"
    {
    }
}
)");
    EXPECT_FALSE(loaded.animation) << "what is below a hidden prim can't be shown";
    const auto nodes = nodesByPath(*loaded.scene);
    EXPECT_EQ(nodes.count("/gone"), 0u);
    EXPECT_EQ(nodes.count("/here/c"), 1u);
}

TEST(UsdAnimation, AnAnimatedFileAtAFrameIsTheFileLoadedAtThatFrame) {
    const auto shared = sharedFolder();
    if (!shared) GTEST_SKIP() << "the reference scenes are not here";
    for (const char* name : {"reference/tworoom/tworoom_anim.usda",
                             "reference/office/office_anim.usda", "assets/luxtest/rect.usda"}) {
        const LoadedScene played = loadUsdScene(*shared / name, {.allowOutside = true});
        ASSERT_TRUE(played.animation) << name;
        const double end = played.scene->endTimeCode;
        played.animation->setTime(end);
        const LoadedScene loaded =
            loadUsdScene(*shared / name, {.time = end, .allowOutside = true});
        const auto a = nodesByPath(*played.scene);
        const auto b = nodesByPath(*loaded.scene);
        ASSERT_EQ(a.size(), b.size());
        for (const auto& [path, placed] : a) {
            const PlacedNode& other = b.at(path);
            if (placed.light() && sizeOf(placed) != sizeOf(other)) { // it has been resized
                for (int k = 0; k < 3; ++k)
                    EXPECT_LT(glm::distance(sideOf(placed, k), sideOf(other, k)), 1e-6) << path;
                EXPECT_EQ(placed.toWorld[3], other.toWorld[3]) << path;
                if (sizeOf(other).z == 0) { // it shines the same way
                    EXPECT_EQ(placed.toWorld[2], other.toWorld[2]) << path;
                }
            } else {
                EXPECT_EQ(placed.toWorld, other.toWorld) << path;
            }
            if (!placed.light()) continue;
            EXPECT_EQ(placed.light()->luminance(), b.at(path).light()->luminance()) << path;
        }
    }
}

} // namespace penumbra
