#include "tests/io/usd/UsdTestFiles.h"

#include "scenegraph/Find.h"
#include "scenegraph/Objects.h"
#include "scenegraph/Transform.h"

#include <gtest/gtest.h>

namespace penumbra {

namespace {

std::vector<std::string> paths(const LoadedScene& loaded) {
    std::vector<std::string> list;
    for (const auto& [path, placed] : nodesByPath(*loaded.scene)) list.push_back(path);
    return list;
}

using Paths = std::vector<std::string>;

const std::string kMoved = " double3 xformOp:translate = (1, 2, 3)\n uniform token[] xformOpOrder "
                           "= [\"xformOp:translate\"]\n";

} // namespace

TEST(UsdScene, OneWithNothingToBeSeenSaysWhatIsInItInstead) {
    const auto last = [](const std::string& text) {
        return loadText(text).diagnostics.back().text;
    };
    const std::string none = "nothing in it has a shape that can be shown, or gives light: ";
    EXPECT_EQ(last(""), none + "it has no prims");
    EXPECT_EQ(last("def Scope \"a\"\n{\n def \"b\"\n {\n }\n}\nclass \"c\"\n{\n}\n"),
              none + "3 prims (2 without a type, 1 Scope), 1 of them classes or overs");
    EXPECT_TRUE(loadText("def Cube \"a\"\n{\n}\n").diagnostics.empty());
}

TEST(UsdScene, PathsAreThoseOfTheFile) {
    const LoadedScene loaded =
        loadText("def Xform \"World\"\n{\n def Scope \"S\"\n {\n  def Cube \"c\"\n  {\n  }\n }\n "
                 "def Odd \"o\"\n {\n"
                 "  def RectLight \"l\"\n  {\n  }\n }\n def Camera \"cam\"\n {\n }\n}\n");
    EXPECT_EQ(paths(loaded), (Paths{"/", "/World", "/World/S", "/World/S/c", "/World/cam",
                                    "/World/o", "/World/o/l"}));
    EXPECT_TRUE(nodesByPath(*loaded.scene).at("/World/S/c").mesh());
}

TEST(UsdScene, ALeafWithItsOwnPlaceIsHeldByATransform) {
    const LoadedScene loaded =
        loadText("(metersPerUnit = 1)\ndef Camera \"c\"\n{\n" + kMoved + "}\n");
    EXPECT_TRUE(findAt<Transform>(*loaded.scene->root, "/c"));
    const PlacedScene placed = placeScene(*loaded.scene);
    ASSERT_EQ(placed.cameras.size(), 1u);
    EXPECT_EQ(placed.cameras[0].path, "/c"); // as the file has it
    EXPECT_EQ(glm::dvec3(placed.cameras[0].toWorld[3]), glm::dvec3(1, 2, 3));
}

TEST(UsdScene, AMeshWithChildrenIsHeldByAGroup) {
    const LoadedScene loaded = loadText("def Cube \"c\"\n{\n def Sphere \"s\"\n {\n }\n}\n");
    EXPECT_EQ(paths(loaded), (Paths{"/", "/c", "/c/s"}));
    EXPECT_EQ(nodesAt(*loaded.scene->root, "/c").size(), 2u);
}

TEST(UsdScene, TheWorldIsInMetres) {
    // Without metersPerUnit a unit is a centimetre: a default cube measures 2 cm.
    const LoadedScene loaded = loadText("def Cube \"c\"\n{\n}\n");
    EXPECT_DOUBLE_EQ(loaded.scene->metersPerUnit, 0.01);
    const auto nodes = nodesByPath(*loaded.scene);
    EXPECT_NEAR(surfaceArea(*nodes.at("/c").mesh(), nodes.at("/c").toWorld), 6 * 0.02 * 0.02, 1e-9);
    const LoadedScene inches = loadText("(metersPerUnit = 0.0254)\n");
    EXPECT_DOUBLE_EQ(inches.scene->metersPerUnit, 0.0254);
    const LoadedScene nonsense = loadText("(metersPerUnit = 0)\n");
    EXPECT_DOUBLE_EQ(nonsense.scene->metersPerUnit, 0.01);
    EXPECT_EQ(countOf(nonsense, "metersPerUnit"), 1u);
}

TEST(UsdScene, TheDefaultPrimMayAskForAPatchSize) {
    const auto asking = [](const std::string& size) {
        return loadText("(\n defaultPrim = \"w\"\n metersPerUnit = 0.01\n)\ndef Xform \"w\"\n{\n" +
                        size + "}\n");
    };
    EXPECT_FALSE(asking("").asked.patchSize);
    const std::string attribute = " custom uniform double penumbra:patchSize = ";
    EXPECT_DOUBLE_EQ(asking(attribute + "25\n").asked.patchSize.value_or(0), 0.25);
    for (const char* nonsense : {"-1\n", "0\n", "nan\n"}) {
        const LoadedScene loaded = asking(attribute + nonsense);
        EXPECT_FALSE(loaded.asked.patchSize) << nonsense;
        EXPECT_EQ(countOf(loaded, "patch size ignored"), 1u) << nonsense;
    }
}

TEST(UsdScene, TheDefaultPrimMayAskForSizesToleranceTriggerAndOrder) {
    const LoadedScene loaded =
        loadText("(\n defaultPrim = \"w\"\n metersPerUnit = 0.01\n)\ndef Xform \"w\"\n{\n"
                 " custom uniform double penumbra:elementSize = 4\n"
                 " custom uniform double penumbra:residual = 0.001\n"
                 " custom uniform token penumbra:trigger = \"continuous\"\n"
                 " custom uniform token penumbra:order = \"fastest\"\n}\n");
    EXPECT_DOUBLE_EQ(loaded.asked.elementSize.value_or(0), 0.04);
    EXPECT_DOUBLE_EQ(loaded.asked.residual.value_or(0), 0.001);
    EXPECT_EQ(loaded.asked.trigger, Trigger::continuous);
    EXPECT_FALSE(loaded.asked.policy);
    EXPECT_EQ(countOf(loaded, "'fastest' is none of importance, plain"), 1u);
}

TEST(UsdScene, AxesAndFramesAreRecorded) {
    const LoadedScene loaded = loadText(
        "(upAxis = \"Z\"\n startTimeCode = 3\n endTimeCode = 9\n timeCodesPerSecond = 30)\n");
    EXPECT_EQ(loaded.scene->upAxis, UpAxis::z);
    EXPECT_EQ(loaded.scene->startTimeCode, 3);
    EXPECT_EQ(loaded.scene->endTimeCode, 9);
    EXPECT_EQ(loaded.scene->timeCodesPerSecond, 30);
    EXPECT_EQ(loadText("").scene->upAxis, UpAxis::y);
    EXPECT_EQ(countOf(loadText("(upAxis = \"X\")\n"), "upAxis"), 1u);
}

TEST(UsdScene, LayersOfOtherUnitsOrAxesAreTakenAsTheyAreWithAWord) {
    const TemporaryFolder folder;
    const std::string cube = "def Cube \"c\"\n{\n}\n";
    folder.write("inches.usda",
                 "#usda 1.0\n(metersPerUnit = 0.0254\n defaultPrim = \"c\")\n" + cube);
    folder.write("tilted.usda", "#usda 1.0\n(upAxis = \"Z\"\n defaultPrim = \"c\")\n" + cube);
    folder.write("silent.usda", "#usda 1.0\n(defaultPrim = \"c\")\n" + cube);
    const auto with = [&](const std::string& references) {
        return loadUsdScene(
            folder.write("scene.usda", "#usda 1.0\n(metersPerUnit = 1)\n" + references));
    };
    const std::string inches = "def \"a\" (references = @inches.usda@)\n{\n}\n";
    const std::string tilted = "def \"b\" (references = @tilted.usda@)\n{\n}\n";
    const char* const said = "has another metersPerUnit or upAxis than the scene";
    EXPECT_EQ(countOf(with(inches), said), 1u);
    EXPECT_EQ(countOf(with(tilted), said), 1u);
    EXPECT_EQ(countOf(with(inches + tilted), "taken as it is (and 1 more)"), 1u);
    EXPECT_EQ(countOf(with("def \"d\" (references = @silent.usda@)\n{\n}\n"), said), 0u)
        << "says nothing of it";
}

TEST(UsdScene, TheSceneIsReadAtItsFirstFrameUnlessAskedOtherwise) {
    const std::string text =
        "(metersPerUnit = 1\n startTimeCode = 2)\ndef Xform \"x\"\n{\n double3 "
        "xformOp:translate.timeSamples = { 0: (0, 0, 0), "
        "10: (10, 0, 0) }\n uniform token[] xformOpOrder = [\"xformOp:translate\"]\n}\n";
    EXPECT_EQ(nodesByPath(*loadText(text).scene).at("/x").toWorld[3].x, 2);
    EXPECT_EQ(nodesByPath(*loadText(text, {.time = 7}).scene).at("/x").toWorld[3].x, 7);
}

TEST(UsdScene, WhatIsNotShownIsNotThere) {
    const LoadedScene loaded = loadText(
        "def Xform \"hidden\"\n{\n token visibility = \"invisible\"\n def Cube \"c\"\n {\n }\n}\n"
        "def Cube \"guide\"\n{\n uniform token purpose = \"guide\"\n}\ndef Cube \"render\"\n{\n "
        "uniform token purpose = \"render\"\n}\n"
        "def Cube \"off\" (active = false)\n{\n}\nover Cube \"over\"\n{\n}\nclass Cube "
        "\"class\"\n{\n}\n"
        "def Scope \"proxies\"\n{\n uniform token purpose = \"proxy\"\n def Cube \"c\"\n {\n "
        "}\n}\n");
    EXPECT_EQ(paths(loaded), (Paths{"/", "/proxies", "/render"}));
}

TEST(UsdScene, CamerasKeepTheirLens) {
    const LoadedScene loaded =
        loadText("def Camera \"c\"\n{\n float focalLength = 18\n float horizontalAperture = 36\n "
                 "float2 clippingRange = (0.1, 50)\n"
                 " token projection = \"orthographic\"\n}\ndef Camera \"bad\"\n{\n float "
                 "focalLength = 0\n}\n");
    const auto nodes = nodesByPath(*loaded.scene);
    const Lens& lens = nodes.at("/c").camera()->lens();
    EXPECT_EQ(lens.focalLength, 18);
    EXPECT_EQ(lens.horizontalAperture, 36);
    EXPECT_FLOAT_EQ(lens.verticalAperture, 15.2908f);
    EXPECT_EQ(lens.clippingRange, glm::vec2(0.1f, 50));
    EXPECT_FALSE(lens.perspective);
    EXPECT_EQ(nodes.at("/bad").camera()->lens().focalLength, 50);
}

TEST(UsdScene, WhatIsMissingIsSummedUpBeforeWhatIsCommon) {
    Diagnostics diagnostics;
    for (const char* text : {"a", "b", "c", "d"}) diagnostics.warn({}, text, 9);
    diagnostics.warn({}, "reference @x.usda@<> of </x> left out: can't be opened");
    EXPECT_TRUE(summary(diagnostics.list()).starts_with("37 warnings: reference @x.usda@"))
        << summary(diagnostics.list());
}

TEST(UsdScene, WhatIsNotUnderstoodIsSummedUpInOneLine) {
    const LoadedScene loaded =
        loadText("def BasisCurves \"a\"\n{\n}\ndef BasisCurves \"b\"\n{\n}\ndef Volume "
                 "\"v\"\n{\n}\ndef Cube \"c\"\n{\n}\n");
    EXPECT_EQ(paths(loaded), (Paths{"/", "/c"}));
    const std::string line = summary(loaded.diagnostics);
    EXPECT_EQ(line, "3 warnings: 2 x BasisCurves not supported yet: left out; Volume not "
                    "supported yet: left out");
    EXPECT_EQ(summary({}), "");
    ASSERT_EQ(loaded.diagnostics.size(), 2u);
    EXPECT_TRUE(loaded.diagnostics[0].line().ends_with(
        "scene.usda:2:1: warning: BasisCurves not supported yet: left out (2 times)"));
}

TEST(UsdScene, TheReferenceScenesLoadWithoutAWord) {
    const auto shared = sharedFolder();
    if (!shared) GTEST_SKIP() << "the reference scenes are not here";
    int files = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(*shared / "reference")) {
        if (entry.path().extension() != ".usda") continue;
        const auto diagnostics = loadUsdScene(entry.path()).diagnostics;
        const bool hasSky = entry.path().parent_path().filename() == "daylight";
        // Sun, sky and glass are what these scenes are about; each is named as long as it is left
        // out.
        for (const Diagnostic& diagnostic : diagnostics)
            EXPECT_TRUE(hasSky && (diagnostic.text.find("DistantLight") != std::string::npos ||
                                   diagnostic.text.find("DomeLight") != std::string::npos ||
                                   diagnostic.text.find("transparency") != std::string::npos))
                << entry.path() << ": " << summary(diagnostics);
        ++files;
    }
    EXPECT_GE(files, 19);
}

} // namespace penumbra
