// A scene that is played to a time is the scene that is loaded at that time.
#include "tests/io/usd/UsdTestFiles.h"

#include "scenegraph/Transform.h"

#include <gtest/gtest.h>

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

} // namespace penumbra
