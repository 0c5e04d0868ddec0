#include "UsdTestFiles.h"

#include "scenegraph/Transform.h"

#include <gtest/gtest.h>

namespace penumbra {

TEST(UsdAnimation, AStillSceneHasNone) {
    EXPECT_FALSE(loadText("def Cube \"c\"\n{\n}\n").animation);
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
    const Light& lamp = *nodes.at("/lamp").light();
    const Material& tube = *nodes.at("/tube").mesh()->data().materials.at(0);
    const Material& paint = *nodes.at("/painted").mesh()->data().materials.at(0);
    const std::uint64_t before = goes.revision();

    loaded.animation->setTime(0); // where it is already
    EXPECT_EQ(goes.revision(), before);
    EXPECT_EQ(lamp.revision(), 1u);

    const std::uint64_t still = stays.revision();
    loaded.animation->setTime(5);
    EXPECT_EQ(goes.matrix()[3].x, 5);
    EXPECT_GT(goes.revision(), before);
    EXPECT_EQ(stays.revision(), still);
    EXPECT_EQ(lamp.luminance(), Rgb(150));
    EXPECT_EQ(tube.emission(), Rgb(1.5f));
    EXPECT_EQ(nodes.at("/eye").camera()->lens().focalLength, 75);
    EXPECT_EQ(paint.reflectance(), Rgb(0.25f));
}

TEST(UsdAnimation, AnAnimatedFileAtAFrameIsTheFileLoadedAtThatFrame) {
    const auto shared = sharedFolder();
    if (!shared) GTEST_SKIP() << "the reference scenes are not here";
    for (const char* name : {"reference/tworoom/tworoom_anim.usda",
                             "reference/office/office_anim.usda", "assets/luxtest/rect.usda"}) {
        const LoadedScene played = loadUsdScene(*shared / name);
        ASSERT_TRUE(played.animation) << name;
        const double end = played.scene->endTimeCode;
        played.animation->setTime(end);
        const LoadedScene loaded = loadUsdScene(*shared / name, {.time = end});
        const auto a = nodesByPath(*played.scene);
        const auto b = nodesByPath(*loaded.scene);
        ASSERT_EQ(a.size(), b.size());
        for (const auto& [path, placed] : a) {
            EXPECT_EQ(placed.toWorld, b.at(path).toWorld) << path;
            if (!placed.light()) continue;
            EXPECT_EQ(placed.light()->luminance(), b.at(path).light()->luminance()) << path;
        }
    }
}

} // namespace penumbra
