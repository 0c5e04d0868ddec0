// A scene that is played to a time is the scene that is loaded at that time.
#include "tests/io/usd/UsdTestFiles.h"

#include "io/usd/stage/UsdSampleCheck.h"
#include "scenegraph/Transform.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

namespace penumbra {

namespace {

void expectSamePaint(const Mesh& played, const Mesh& loaded, const std::string& where) {
    const auto& a = played.data().materials;
    const auto& b = loaded.data().materials;
    ASSERT_EQ(a.size(), b.size()) << where;
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i]->emission(), b[i]->emission()) << where;
        EXPECT_EQ(a[i]->reflectance(), b[i]->reflectance()) << where;
    }
}

void expectSame(const Scene& played, const Scene& loaded, const std::string& when) {
    const auto a = nodesByPath(played);
    const auto b = nodesByPath(loaded);
    ASSERT_EQ(a.size(), b.size()) << when;
    for (const auto& [path, placed] : a) {
        const std::string where = path + when;
        ASSERT_EQ(b.count(path), 1u) << where;
        EXPECT_EQ(placed.toWorld, b.at(path).toWorld) << where;
        if (placed.light()) {
            EXPECT_EQ(placed.light()->luminance(), b.at(path).light()->luminance()) << where;
        }
        if (placed.mesh()) expectSamePaint(*placed.mesh(), *b.at(path).mesh(), where);
    }
}

/// Plays a scene from time code 1 on, forth and back.
void expectPlayedAsLoaded(const std::string& body) {
    const std::string text = "(metersPerUnit = 1\n startTimeCode = 1)\n" + body;
    const LoadedScene played = loadText(text);
    ASSERT_TRUE(played.animation);
    for (const double time : {2.0, 4.0, 3.0, 1.5, 1.0}) {
        played.animation->setTime(time);
        expectSame(*played.scene, *loadText(text, {.time = time}).scene,
                   " at " + std::to_string(time));
    }
}

const std::string kGrows = " double3 xformOp:scale.timeSamples = { 1: (1, 1, 1), 2: (2, 3, 1), "
                           "4: (.3, .5, .7) }\n"
                           " uniform token[] xformOpOrder = [\"xformOp:scale\"]\n";

std::string sizedLight(const std::string& type, const std::string& body) {
    return "def " + type + " \"" + type + "\"\n{\n bool inputs:normalize = 1\n" +
           " float inputs:intensity = 500\n" + body + "}\n";
}

} // namespace

TEST(UsdTracks, ANormalizedLightKeepsItsFluxAsItIsResized) {
    const LoadedScene loaded =
        loadText("(metersPerUnit = 1\n startTimeCode = 1)\n" + sizedLight("RectLight", kGrows));
    loaded.animation->setTime(2);
    const auto nodes = nodesByPath(*loaded.scene);
    EXPECT_FLOAT_EQ(leafOf(nodes, "/RectLight")->light()->luminance().g, 500.0f / 6);
}

TEST(UsdTracks, ANormalizedLightIsAsLoadedWhereverWhatResizesItIs) {
    for (const char* type : {"RectLight", "DiskLight", "SphereLight", "CylinderLight"}) {
        expectPlayedAsLoaded(sizedLight(type, kGrows));
        expectPlayedAsLoaded("def Xform \"a\"\n{\n" + kGrows + " def Scope \"s\"\n {\n" +
                             sizedLight(type, " double3 xformOp:translate = (.1, .2, .3)\n"
                                              " uniform token[] xformOpOrder = "
                                              "[\"xformOp:translate\"]\n") +
                             " }\n}\n");
    }
}

TEST(UsdTracks, AMeshThatIsALightIsAsLoaded) {
    const auto mesh = [](const std::string& body) {
        return "def Mesh \"m\" (apiSchemas = [\"MeshLightAPI\"])\n{\n" + body +
               " point3f[] points = [(0, 0, 0), (1, 0, 0), (1, 2, 0), (0, 2, 0)]\n"
               " int[] faceVertexCounts = [4]\n int[] faceVertexIndices = [0, 1, 2, 3]\n"
               " rel material:binding = </M>\n}\n"
               "def Cube \"c\"\n{\n rel material:binding = </M>\n}\n";
    };
    const auto material = [](const std::string& input) {
        return "def Material \"M\"\n{\n token outputs:surface.connect = </M/S.outputs:surface>\n"
               " def Shader \"S\"\n {\n  uniform token info:id = \"UsdPreviewSurface\"\n" +
               input + " }\n}\n";
    };
    const std::string still = material("");
    const std::string brightens = " float inputs:intensity.timeSamples = { 1: 5, 3: 9 }\n";
    expectPlayedAsLoaded(mesh(" bool inputs:normalize = 1\n" + kGrows) + still);
    expectPlayedAsLoaded(mesh(brightens) + still);
    const std::string samples = ".timeSamples = { 1: (.1, .2, .3), 4: (.5, .4, .3) }\n";
    for (const char* colour : {"diffuseColor", "emissiveColor"})
        expectPlayedAsLoaded(mesh(brightens) +
                             material("  color3f inputs:" + std::string(colour) + samples));
}

namespace {

const std::string kGoes = " double3 xformOp:translate.timeSamples = { 1: (0, 0, 0), 2: (1, 0, .3), "
                          "4: (0, 1, 0) }\n"
                          " float3 xformOp:rotateXYZ.timeSamples = { 1: (0, 0, 0), 4: (10, 50, 9) "
                          "}\n"
                          " uniform token[] xformOpOrder = [\"xformOp:translate\", "
                          "\"xformOp:rotateXYZ\"]\n";

/// A prim below a moving one, which it leaves behind.
std::string leavesAMovingParent(const std::string& translate, const std::string& below) {
    return "def Xform \"goes\"\n{\n" + kGoes + " def Xform \"child\"\n {\n  double3 " + translate +
           "\n  uniform token[] xformOpOrder = [\"!resetXformStack!\", \"xformOp:translate\"]\n" +
           below + " }\n}\n";
}

const char* const kStands = "xformOp:translate = (2, 1, 0)";
const char* const kWalks = "xformOp:translate.timeSamples = { 1: (2, 1, 0), 3: (2.5, 1, 0) }";

} // namespace

TEST(UsdTracks, WhatResetsTheStackStandsStillBelowAMovingParent) {
    const LoadedScene loaded = loadText("(metersPerUnit = 1\n startTimeCode = 1)\n" +
                                        leavesAMovingParent(kStands, "def Cube \"c\"\n{\n}\n"));
    loaded.animation->setTime(2);
    const glm::dvec4 at = nodesByPath(*loaded.scene).at("/goes/child/c").toWorld[3];
    EXPECT_NEAR(glm::length(at - glm::dvec4(2, 1, 0, 1)), 0, 1e-12);
}

TEST(UsdTracks, WhatResetsTheStackBelowAMovingParentIsAsLoaded) {
    const std::string cube = "def Cube \"c\"\n{\n}\n";
    const std::string follows = "def Cube \"d\"\n{\n" + kGoes + "}\n";
    for (const char* translate : {kStands, kWalks}) {
        expectPlayedAsLoaded(leavesAMovingParent(translate, cube + follows));
        expectPlayedAsLoaded(leavesAMovingParent(translate, sizedLight("SphereLight", kGrows)));
        expectPlayedAsLoaded(leavesAMovingParent(translate, leavesAMovingParent(kWalks, cube)));
        expectPlayedAsLoaded(
            "def PointInstancer \"many\"\n{\n" + kGoes +
            " int[] protoIndices = [0, 0]\n"
            " point3f[] positions = [(0, 0, 0), (5, 0, 0)]\n"
            " rel prototypes = </many/child>\n def Cube \"child\"\n {\n  double3 " +
            translate +
            "\n  uniform token[] xformOpOrder = [\"!resetXformStack!\", "
            "\"xformOp:translate\"]\n }\n}\n");
    }
}

TEST(UsdTracks, WhatLeavesAMovingParentBehindIsAnObjectOfItsOwn) {
    const LoadedScene loaded =
        loadText("(metersPerUnit = 1)\n" + leavesAMovingParent(kStands, "def Cube \"c\"\n{\n}\n"));
    const auto nodes = nodesByPath(*loaded.scene);
    EXPECT_TRUE(dynamic_cast<const Transform&>(*nodes.at("/goes/child").node).beginsObject());
}

namespace {

/// Lines of the scene's warnings, from `line:column` on.
std::vector<std::string> warningsOf(const std::string& body, const LoadOptions& options = {}) {
    std::vector<std::string> lines;
    for (const Diagnostic& d :
         loadText("(metersPerUnit = 1\n startTimeCode = 1)\n" + body, options).diagnostics) {
        const std::string line = d.line();
        lines.push_back(line.substr(line.find(".usda:") + 6));
    }
    return lines;
}

std::string cubeWith(const std::string& op, const std::string& samples,
                     const std::string& prefix = "") {
    return "def Cube \"c\"\n{\n float3 xformOp:" + op + ".timeSamples = { " + samples +
           " }\n uniform token[] xformOpOrder = [\"" + prefix + "xformOp:" + op + "\"]\n}\n";
}

} // namespace

TEST(UsdTracks, ASampleThatCanNotBeUsedIsReportedWhenTheSceneIsLoaded) {
    using testing::ElementsAre;
    const std::string beyond = "transform op skipped: its value is not finite, or beyond 1e7";
    EXPECT_THAT(warningsOf(cubeWith("translate", "1: (0, 0, 0), 2: (2e7, 0, 0), 2.5: (1, 0, 0), "
                                                 "4: (0, inf, 0), 5: (0, 0, 0)")),
                ElementsAre("6:2: warning: at time code 2: " + beyond,
                            "6:2: warning: at time code 4: " + beyond));
    EXPECT_THAT(warningsOf(cubeWith("scale", "1: (1, 1, 1), 3: (nan, 1, 1)")),
                ElementsAre("6:2: warning: at time code 3: " + beyond));
    EXPECT_THAT(
        warningsOf(cubeWith("scale", "1: (1, 1, 1), 3: (0, 1, 1)", "!invert!")),
        ElementsAre("6:2: warning: at time code 3: transform op skipped: its matrix is not finite "
                    "or can't be inverted"));
    EXPECT_THAT(warningsOf("def SphereLight \"l\"\n{\n float inputs:intensity.timeSamples = "
                           "{ 1: 5, 2: -5, 3: nan }\n}\n"),
                ElementsAre("6:2: warning: at time code 2: a light whose luminance is negative or "
                            "not finite sends none",
                            "6:2: warning: at time code 3: a light whose luminance is negative or "
                            "not finite sends none"));
    EXPECT_THAT(
        warningsOf("def Camera \"eye\"\n{\n float focalLength.timeSamples = { 1: 50, 2: inf }\n}\n"
                   "def Cube \"c\"\n{\n}\n"),
        ElementsAre("6:2: warning: at time code 2: a number of a lens ignored: not finite"));
    EXPECT_THAT(warningsOf("def Cube \"c\"\n{\n rel material:binding = </M>\n}\n"
                           "def Material \"M\"\n{\n"
                           " token outputs:surface.connect = </M/S.outputs:surface>\n"
                           " def Shader \"S\"\n {\n"
                           "  uniform token info:id = \"UsdPreviewSurface\"\n"
                           "  color3f inputs:diffuseColor.timeSamples = { 1: (1, 1, 1), 2: (nan, "
                           "1, 1) }\n }\n}\n"),
                ElementsAre("14:3: warning: at time code 2: a number of a material ignored: not "
                            "finite"));
}

TEST(UsdTracks, ASampleThatTheLoadHasReadIsReportedOnce) {
    const std::string body = cubeWith("translate", "1: (0, 0, 0), 2: (2e7, 0, 0), 3: (0, 0, 0)");
    for (const double time : {1.0, 2.0, 3.0, 7.0})
        EXPECT_EQ(warningsOf(body, {.time = time}).size(), 1u) << time;
    const std::string end = cubeWith("translate", "1: (0, 0, 0), 2: (2e7, 0, 0)");
    EXPECT_EQ(warningsOf(end, {.time = 9}).size(), 1u) << "the last sample holds";
}

TEST(UsdTracks, ASampleThatManyPrimsShareIsReportedOnceAndInTheirTime) {
    const std::string later = " (references = </c> (offset = 10))";
    const auto lines = warningsOf(
        "def Cube \"a\"" + later + "\n{\n}\ndef Cube \"b\"" + later + "\n{\n}\nover " +
        cubeWith("translate", "1: (0, 0, 0), 2: (2e7, 0, 0)").substr(std::string("def ").size()));
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_NE(lines[0].find("at time code 12: transform op skipped"), std::string::npos)
        << lines[0];
    EXPECT_EQ(lines[0].find("times"), std::string::npos) << lines[0];
}

TEST(UsdTracks, WhatALightIgnoresFromATimeOnIsReportedOnce) {
    const auto cone = [](const char* samples) {
        return warningsOf("def SphereLight \"l\"\n{\n float inputs:shaping:cone:angle.timeSamples "
                          "= { " +
                          std::string(samples) + " }\n}\n");
    };
    EXPECT_THAT(cone("1: 90, 2: 50, 3: 40"),
                testing::ElementsAre("6:2: warning: at time code 2: shaping of a light ignored"));
    EXPECT_THAT(cone("1: 50, 2: 40"),
                testing::ElementsAre("6:2: warning: shaping of a light ignored"));
}

TEST(UsdTracks, EachSampleOfEachOpIsGoneThroughOnce) {
    // Each op has times of its own: reading all of them at each time would be the square of that.
    constexpr int kOps = 50, kSamples = 4;
    std::string ops;
    std::vector<std::string> names;
    for (int op = 0; op < kOps; ++op) {
        names.push_back("xformOp:translateX:o" + std::to_string(op));
        ops += " double " + names.back() + ".timeSamples = { ";
        for (int i = 0; i < kSamples; ++i)
            ops += std::to_string(i) + "." + std::to_string(op + 100) + ": 1e8, ";
        ops += "}\n";
    }
    const TemporaryFolder folder;
    folder.write("ops.usda", "#usda 1.0\ndef Cube \"c\"\n{\n" + ops + "}\n");
    UsdStage stage = UsdStage::open(folder.file("ops.usda"));
    UsdSampleCheck check(std::nullopt, stage.diagnostics());
    int reads = 0;
    for (const std::string_view name : names)
        check.each(*stage.find("/c"), {&name, 1}, "op",
                   [&](const UsdAttributes&, Diagnostics&) { ++reads; });
    EXPECT_EQ(reads, kOps * (kSamples - 1)) << "the first is what the load reads";
}

} // namespace penumbra
