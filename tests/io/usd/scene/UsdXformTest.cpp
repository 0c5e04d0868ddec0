// Matrices are those of OpenUSD 24.11, rows as it prints them.
#include "tests/io/usd/UsdTestFiles.h"

#include "scenegraph/Transform.h"

#include <gtest/gtest.h>

namespace penumbra {

namespace {

// Row r of OpenUSD's matrix is our column r.
void expectRows(const glm::dmat4& m, std::array<glm::dvec3, 3> rows, glm::dvec3 origin = {}) {
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(m[r][c], rows[std::size_t(r)][c], 1e-6) << r << c;
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(m[3][c], origin[c], 1e-6) << "origin " << c;
}

glm::dmat4 matrixOf(const LoadedScene& loaded, const std::string& path) {
    return nodesByPath(*loaded.scene).at(path).toWorld;
}

// World matrix of an Xform </a> with those ops, in a scene of metres.
glm::dmat4 matrix(const std::string& ops) {
    return matrixOf(loadText("(metersPerUnit = 1)\ndef Xform \"a\"\n{\n" + ops + "\n}\n"), "/a");
}

std::string one(const std::string& type, const std::string& name, const std::string& value) {
    return type + " xformOp:" + name + " = " + value +
           "\nuniform token[] xformOpOrder = [\"xformOp:" + name + "\"]";
}

} // namespace

TEST(UsdXform, RotationsTurnAboutTheFirstLetterFirst) {
    expectRows(matrix(one("float3", "rotateXYZ", "(30, 60, 90)")),
               {{{0, .5, -.8660254}, {-.8660254, .4330127, .25}, {.5, .75, .4330127}}});
    expectRows(matrix(one("float3", "rotateZYX", "(30, 60, 90)")),
               {{{0, .8660254, .5}, {-.5, -.4330127, .75}, {.8660254, -.25, .4330127}}});
    expectRows(matrix(one("float3", "rotateYXZ", "(30, 60, 90)")),
               {{{-.4330127, .5, -.75}, {-.8660254, 0, .5}, {.25, .8660254, .4330127}}});
    expectRows(matrix(one("float", "rotateX", "30")),
               {{{1, 0, 0}, {0, .8660254, .5}, {0, -.5, .8660254}}});
    expectRows(matrix(one("double", "rotateY", "30")),
               {{{.8660254, 0, -.5}, {0, 1, 0}, {.5, 0, .8660254}}});
    expectRows(matrix(one("half", "rotateZ", "90")), {{{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}}});
    expectRows(matrix(one("quatf", "orient", "(.70710677, .70710677, 0, 0)")),
               {{{1, 0, 0}, {0, 0, 1}, {0, -1, 0}}});
}

TEST(UsdXform, ScalarOpsMoveAndScaleOneAxis) {
    expectRows(matrix(one("double", "translateY", "3")), {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
               {0, 3, 0});
    expectRows(matrix(one("float", "scaleZ", "3")), {{{1, 0, 0}, {0, 1, 0}, {0, 0, 3}}});
}

TEST(UsdXform, TheFirstListedOpIsTheOutermost) {
    const LoadedScene loaded =
        loadText("(metersPerUnit = 1)\ndef Xform \"a\"\n{\n double3 xformOp:translate = (10, 20, "
                 "30)\n float3 xformOp:rotateXYZ = (30, 60, 90)\n"
                 " float3 xformOp:scale = (2, 3, 4)\n uniform token[] xformOpOrder = "
                 "[\"xformOp:translate\", \"xformOp:rotateXYZ\", "
                 "\"xformOp:scale\"]\n def Xform \"b\"\n {\n  double3 xformOp:translate = (1, 1, "
                 "1)\n  uniform token[] xformOpOrder = "
                 "[\"xformOp:translate\"]\n }\n}\n");
    const glm::dvec3 origin(matrixOf(loaded, "/a/b")[3]);
    EXPECT_NEAR(origin.x, 9.40192379, 1e-6);
    EXPECT_NEAR(origin.y, 25.2990381, 1e-6);
    EXPECT_NEAR(origin.z, 30.75, 1e-6);
}

TEST(UsdXform, InvertedOpsUndoTheirNamesakes) {
    expectRows(
        matrix("double3 xformOp:translate = (0, 0, 5)\nfloat3 xformOp:translate:pivot = (1, 0, 0)\n"
               "float3 xformOp:rotateXYZ = (0, 0, 90)\nuniform token[] xformOpOrder = "
               "[\"xformOp:translate\", "
               "\"xformOp:translate:pivot\", \"xformOp:rotateXYZ\", "
               "\"!invert!xformOp:translate:pivot\"]"),
        {{{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}}}, {1, -1, 5});
}

TEST(UsdXform, AResetStackLeavesTheParentsBehindButNotTheUnit) {
    const LoadedScene loaded =
        loadText("(metersPerUnit = 0.01)\ndef Xform \"a\"\n{\n double3 xformOp:translate = (7, 7, "
                 "7)\n uniform token[] xformOpOrder = "
                 "[\"xformOp:translate\"]\n def Xform \"b\"\n {\n  double3 xformOp:translate = "
                 "(100, 200, 300)\n  uniform token[] "
                 "xformOpOrder = [\"!resetXformStack!\", \"xformOp:translate\"]\n }\n}\n");
    expectRows(matrixOf(loaded, "/a/b"), {{{.01, 0, 0}, {0, .01, 0}, {0, 0, .01}}}, {1, 2, 3});
}

TEST(UsdXform, OnlyListedOpsCount) {
    expectRows(matrix("double3 xformOp:translate = (9, 9, 9)"),
               {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}});
}

TEST(UsdXform, UnusableOpsAreSkippedWithAWarning) {
    for (const char* ops :
         {"uniform token[] xformOpOrder = [\"xformOp:translate\"]",
          "double xformOp:translate = 1\nuniform token[] xformOpOrder = [\"xformOp:translate\"]",
          "double3 xformOp:translate = (inf, 0, 0)\nuniform token[] xformOpOrder = "
          "[\"xformOp:translate\"]",
          "double3 xformOp:bend = (1, 0, 0)\nuniform token[] xformOpOrder = [\"xformOp:bend\"]",
          "double3 xformOp:translate = (1e30, 0, 0)\nuniform token[] xformOpOrder = "
          "[\"xformOp:translate\"]",
          "float3 xformOp:scale = (1, 1, 0)\nuniform token[] xformOpOrder = "
          "[\"!invert!xformOp:scale\"]"}) {
        const LoadedScene loaded =
            loadText("(metersPerUnit = 1)\ndef Xform \"a\"\n{\n" + std::string(ops) + "\n}\n");
        EXPECT_EQ(countOf(loaded, "transform op skipped"), 1u) << ops;
        expectRows(matrixOf(loaded, "/a"), {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}});
    }
}

TEST(UsdXform, WhatChangesWithTimeBeginsAnObject) {
    const std::string order = " uniform token[] xformOpOrder = [\"xformOp:translate\"]\n";
    const LoadedScene loaded =
        loadText("(metersPerUnit = 1)\ndef Xform \"still\"\n{\n double3 "
                 "xformOp:translate.timeSamples = { 1: (1, 2, 3) }\n" +
                     order +
                     "}\ndef Xform \"goes\"\n{\n double3 xformOp:translate.timeSamples = { 0: (0, "
                     "0, 0), 2: (2, 0, 0) }\n" +
                     order + "}\ndef Xform \"may\"\n{\n custom bool penumbra:movable = true\n}\n",
                 {.time = 1});
    const auto nodes = nodesByPath(*loaded.scene);
    const auto begins = [&](const char* path) {
        return dynamic_cast<const Transform&>(*nodes.at(path).node).beginsObject();
    };
    EXPECT_FALSE(begins("/still"));
    EXPECT_TRUE(begins("/goes"));
    EXPECT_TRUE(begins("/may"));
    expectRows(nodes.at("/goes").toWorld, {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {1, 0, 0});
}

} // namespace penumbra
