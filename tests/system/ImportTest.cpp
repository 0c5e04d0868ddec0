// penumbra import: models of other formats as scenes, and opened directly.
#include "Program.h"
#include "tests/support/ModelTexts.h"

#include <gmock/gmock.h>

namespace penumbra {

namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const char* const kTriangle = "o Roof\nv 0 0 0\nv 1 0 0\nv 1 0 1\nf 1 2 3\n";

/// A floor, 4 m wide, with a bulb of 100 cd above it and a camera.
const std::string kFloor =
    R"([{"children": [1, 2, 3]}, {"name": "Floor", "translation": [-2, 0, -2],
        "scale": [4, 1, 4], "mesh": 0}, {"name": "Bulb", "translation": [0, 2, 0], )" +
    gltfLight(0) +
    R"(}, {"name": "Eye", "translation": [0, 6, 0], "camera": 0,
        "rotation": [-0.70710678, 0, 0, 0.70710678]}])";
const std::string kFloorParts =
    gltfLights(R"([{"type": "point", "intensity": 100}])") +
    R"(, "materials": [{"name": "Paint", "pbrMetallicRoughness": {"metallicFactor": 0,
       "baseColorFactor": [0.5, 0.5, 0.5, 1]}}],
       "cameras": [{"type": "perspective", "perspective":
       {"yfov": 0.8, "aspectRatio": 1.5, "znear": 0.1}}])";

class Import : public testing::Test {
protected:
    Workplace here;

    Outcome import(const std::string& model, const std::string& output,
                   std::vector<std::string> more = {}) {
        std::vector<std::string> arguments{"import", model, "-o", here.path(output)};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return runPenumbra(arguments);
    }
};

TEST_F(Import, WritesASceneAndSaysWhatItTook) {
    const std::string model = here.write("roof.obj", kTriangle);
    const Outcome outcome = import(model, "roof.usda");
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_THAT(outcome.out, IsEmpty());
    EXPECT_THAT(outcome.err, HasSubstr("taken as metres, Y up"));
    EXPECT_THAT(outcome.err, HasSubstr("roof.usda: 1 mesh, 1 face, 0 materials, 0 lights, "
                                       "0 cameras; 1 m a unit, Y up"));
    EXPECT_THAT(here.files(), ElementsAre("roof.obj", "roof.usda"));
    const Outcome given = import(model, "b.usda", {"--unit", "ft", "--up", "z"});
    EXPECT_THAT(given.err, HasSubstr("0.3048 m a unit, Z up"));
    EXPECT_THAT(given.err, Not(HasSubstr("warning")));
}

TEST_F(Import, TheSceneIsWhatTheModelIsWhenOpenedDirectly) {
    const std::string model = here.write("floor.glb", glbBytes(kFloor, kFloorParts));
    ASSERT_EQ(import(model, "floor.usda").exitCode, 0);
    const Outcome direct = runPenumbra({"info", model});
    const Outcome written = runPenumbra({"info", here.path("floor.usda")});
    EXPECT_EQ(direct.exitCode, 0) << direct.err;
    EXPECT_THAT(direct.out, HasSubstr("1 meshes"));
    EXPECT_THAT(direct.out, HasSubstr("100 lux at 1 m")); // 100 cd
    EXPECT_EQ(direct.out.substr(direct.out.find('\n')), written.out.substr(written.out.find('\n')));
}

TEST_F(Import, AModelIsRenderedDirectly) {
    const std::string model = here.write("floor.glb", glbBytes(kFloor, kFloorParts));
    const Outcome outcome =
        runPenumbra({"render", model, "--png", here.path("floor.png"), "--width", "64",
                     "--element-size", "0.5", "--patch-size", "1", "--camera", "/floor/Node/Eye"});
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_EQ(readFile(here.path("floor.png")).substr(1, 3), "PNG");
}

TEST_F(Import, ABulbGivesTheLuxOfItsCandelas) {
    // E = I / d^2 = 100 cd / (2 m)^2 = 25 lux right below it; the sphere's radius is 0.05 m.
    const std::string model = here.write("floor.gltf", gltfText(kFloor, kFloorParts));
    const std::string sensors = here.write("s.csv", "x,y,z,nx,ny,nz\n0,0,0,0,1,0\n");
    const Outcome outcome = runPenumbra({"solve", model, "--sensors", sensors, "--values", "-",
                                         "--gather", "--direct-only", "--quiet"});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    const std::string line = outcome.out.substr(outcome.out.find('\n') + 1);
    EXPECT_NEAR(std::stod(line.substr(line.rfind(',') + 1)), 25, 0.05) << outcome.out;
}

TEST_F(Import, RefusesInOneLineAndWritesNothing) {
    const std::string model = here.write("a.gltf", gltfText(R"([{"mesh": 0}])", "", 9));
    const Outcome broken = import(model, "a.usda");
    EXPECT_EQ(broken.exitCode, 1);
    EXPECT_EQ(lineCount(broken.err), 1u) << broken.err;
    EXPECT_THAT(broken.err, HasSubstr("a.gltf: error: "));
    EXPECT_EQ(runPenumbra({"render", model, "--png", here.path("a.png")}).exitCode, 1);
    EXPECT_THAT(here.files(), ElementsAre("a.gltf"));
}

TEST_F(Import, NeverOverwritesWhatItReads) {
    here.write("a.mtl", "newmtl M\nKd 1 0 0\n");
    const std::string model =
        here.write("a.obj", std::string("mtllib a.mtl\nusemtl M\n") + kTriangle);
    EXPECT_EQ(import(model, "a.obj").exitCode, 2);
    EXPECT_EQ(import(model, "a.mtl").exitCode, 2);
    EXPECT_EQ(import(model, "a.usdc").exitCode, 2);
    EXPECT_EQ(readFile(model).substr(0, 6), "mtllib");
    EXPECT_EQ(import(model, "a.usda", {"--unit", "ell"}).exitCode, 2);
    EXPECT_EQ(runPenumbra({"render", model, "-o", here.path("a.mtl")}).exitCode, 2);
    EXPECT_THAT(here.files(), ElementsAre("a.mtl", "a.obj"));
}

TEST_F(Import, WhatCrashesAssimpIsRefusedAlsoWhereChildrenAreIgnored) {
    std::string text = colladaText(""); // an array without a count, which Assimp 5.2 reads beyond
    text.erase(text.find(R"( count="12")"), 11);
    const Outcome outcome =
        runPenumbra({"info", here.write("a.dae", text)}, {.childrenIgnored = true});
    EXPECT_EQ(outcome.exitCode, 1);
    EXPECT_THAT(outcome.err, HasSubstr("Assimp breaks down on it"));
}

TEST_F(Import, InfoWritesAModelAsTextAndSparesWhatItNames) {
    here.write("a.mtl", "newmtl M\nKd 1 0 0\n");
    const std::string model =
        here.write("a.obj", std::string("mtllib a.mtl\nusemtl M\n") + kTriangle);
    const Outcome outcome = runPenumbra({"info", model, "--text", "-"});
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("def Mesh \"Roof\""));
    EXPECT_THAT(runPenumbra({"info", model, "--composition", "-"}).out, HasSubstr("/a/Roof"));
    for (const char* option : {"--text", "--composition"})
        EXPECT_EQ(runPenumbra({"info", model, option, here.path("a.mtl")}).exitCode, 2) << option;
    EXPECT_THAT(readFile(here.path("a.mtl")), HasSubstr("newmtl"));
}

TEST_F(Import, PicturesWithinTheModelAreWrittenBesideTheScene) {
    const std::string png("\x89PNG\r\n\x1a\n.", 9);
    const std::string model =
        here.write("a.glb", glbBytes(R"([{"mesh": 0}])",
                                     R"(, "materials": [{"pbrMetallicRoughness":
                          {"metallicFactor": 0, "baseColorTexture": {"index": 0}}}],
                          "textures": [{"source": 0}],
                          "images": [{"uri": "data:image/png;base64,)" +
                                         base64(png) + R"("}])"));
    const Outcome outcome = import(model, "out.usda");
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_THAT(here.files(), ElementsAre("a.glb", "out-picture1.png", "out.usda"));
    EXPECT_EQ(readFile(here.path("out-picture1.png")), png);
    EXPECT_THAT(readFile(here.path("out.usda")), HasSubstr("@./out-picture1.png@"));
}

} // namespace

} // namespace penumbra
