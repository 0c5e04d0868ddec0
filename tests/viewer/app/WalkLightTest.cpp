// Light beside a walkthrough, and what follows it: WalkLight, SessionFile, Replay, PictureSaver.
#include "viewer/app/WalkLight.h"

#include "tests/support/TemporaryFolder.h"
#include "tests/viewer/gl/LitScenes.h"
#include "viewer/app/PictureSaver.h"
#include "viewer/app/Replay.h"
#include "viewer/app/SessionFile.h"
#include "viewer/input/Walkthrough.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

namespace penumbra {

namespace {

constexpr glm::ivec2 kPicture{64, 48};

constexpr const char* kRoom = R"(#usda 1.0
(
    metersPerUnit = 1
    upAxis = "Z"
)
def Mesh "Floor"
{
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points = [(-2, -2, 0), (2, -2, 0), (2, 2, 0), (-2, 2, 0)]
    uniform token subdivisionScheme = "none"
}
def Cube "Box"
{
    double size = 0.5
    bool penumbra:movable = 1
    double3 xformOp:translate = (0, 0, 0.5)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
def RectLight "Lamp"
{
    float inputs:intensity = 100
    double3 xformOp:translate = (0, 0, 2)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
def Camera "Eye"
{
    float focalLength = 14
    float2 clippingRange = (0.01, 100)
    double3 xformOp:translate = (0, -4, 1.5)
    float xformOp:rotateX = 75
    uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateX"]
}
)";

class WalkLightTest : public WithContext {
protected:
    void SetUp() override { folder.write("room.usda", kRoom); }
    std::string file(const char* name = "room.usda") const { return folder.file(name); }

    static ReadyScene load(const std::string& path) {
        SceneLoader loader(path);
        while (loader.busy()) {
            if (auto ready = loader.take()) return std::move(*ready);
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        return {};
    }
    static View viewOf(const Walkthrough& walk) { return walk.rig().view(kPicture.x, kPicture.y); }
    static DrawList listOf(const WalkLight& light, const Walkthrough& walk) {
        return light.listVisible(Frustum(viewOf(walk).worldToClip()));
    }
    /// Frames until the light is that of the scene.
    static void settle(WalkLight& light, const Walkthrough& walk) {
        for (int i = 0; i < 10000; ++i) {
            light.update(walk, viewOf(walk));
            const RadiosityState& state = light.state();
            if (state.reached(SolutionState::certified) && state.queued == 0 && state.held == 0)
                return;
            std::this_thread::sleep_for(std::chrono::milliseconds(3));
        }
        FAIL() << "the light has not settled";
    }
    static Transform& box(const Walkthrough& walk) {
        for (const auto& place : walk.loaded().addresses.transforms)
            if (place.prim == "/Box") return *place.node;
        throw std::runtime_error("no box");
    }

    const TemporaryFolder folder;
};

RadiosityOptions coarse(Trigger trigger = Trigger::continuous) {
    RadiosityOptions options;
    options.meshing.patchSize = 1;
    options.meshing.elementSize = 0.5f;
    options.threads = 1;
    options.trigger = trigger;
    return options;
}

TEST_F(WalkLightTest, FirstEverythingIsListedUnlitAndThenLitAndNothingTwice) {
    Walkthrough walk(load(file()));
    WalkLight light(walk, coarse(), makeThreadLink());
    EXPECT_EQ(listOf(light, walk).items.size(), 0u);
    EXPECT_EQ(listOf(light, walk).unlit.size(), 3u) << "floor, box and light, before any update";
    light.update(walk, viewOf(walk));
    const DrawList first = listOf(light, walk);
    EXPECT_EQ(first.items.size() + first.unlit.size(), 3u);
    settle(light, walk);
    EXPECT_TRUE(light.complete());
    const DrawList after = listOf(light, walk);
    EXPECT_EQ(after.unlit.size(), 0u);
    EXPECT_EQ(after.items.size(), 3u);
}

TEST_F(WalkLightTest, WhatGoesDarkLeavesTheDarkAndNoHeadlight) {
    std::string fading = kRoom; // a light that is a mesh
    const auto replace = [&](const std::string& from, const std::string& to) {
        fading.replace(fading.find(from), from.size(), to);
    };
    replace("RectLight", "CylinderLight");
    replace("inputs:intensity = 100", "inputs:intensity.timeSamples = { 1: 100, 2: 0 }");
    folder.write("fading.usda", fading);
    Walkthrough walk(load(file("fading.usda")));
    WalkLight light(walk, coarse(), makeThreadLink());
    EXPECT_FALSE(light.dark());
    walk.loaded().animation->setTime(2);
    walk.followScene();
    light.update(walk, viewOf(walk));
    EXPECT_FALSE(light.dark());
    replace("1: 100", "1: 0");
    folder.write("dark.usda", fading);
    const Walkthrough never(load(file("dark.usda")));
    EXPECT_TRUE(WalkLight(never, coarse(), makeThreadLink()).dark());
}

TEST_F(WalkLightTest, WhatIsInTheHandIsHeldBackUntilItIsLetGo) {
    Walkthrough walk(load(file()));
    WalkLight light(walk, coarse(Trigger::implicit), makeThreadLink());
    settle(light, walk);
    const auto updates = light.state().updates;
    walk.take(ButtonEvent{.button = MouseButton::left, .down = true, .position = {32, 24}},
              kPicture);
    ASSERT_TRUE(walk.selection());
    ASSERT_EQ(walk.selection()->objectPath, "/Box");
    light.update(walk, viewOf(walk));
    for (const double x : {40.0, 44.0, 48.0}) {
        walk.take(MoveEvent{.position = {x, 24}, .moved = {4, 0}}, kPicture);
        light.update(walk, viewOf(walk));
    }
    ASSERT_TRUE(walk.inHand());
    EXPECT_EQ(light.node().previewLights().size(), 1u) << "the light that matters to the box";
    EXPECT_GT(light.lightsPreviewed(), 0u) << "as soon as it moves";
    EXPECT_GT(light.state().held, 0u);
    EXPECT_EQ(light.state().updates, updates);
    walk.take(ButtonEvent{.button = MouseButton::left, .down = false, .position = {48, 24}},
              kPicture);
    settle(light, walk);
    EXPECT_GT(light.state().updates, updates);
}

TEST_F(WalkLightTest, WhereRaysComeTooLateTheNextMoveIsDrawnByShadowMaps) {
    Walkthrough walk(load(file()));
    WalkLight light(walk, coarse(), makeThreadLink(), {.inTime = 0});
    settle(light, walk);
    EXPECT_EQ(light.previewMethod(), PreviewMethod::rays);
    const auto drag = [&](double from) {
        walk.take(ButtonEvent{.button = MouseButton::left, .down = true, .position = {from, 24}},
                  kPicture);
        for (int i = 1; i <= 12; ++i) {
            walk.take(MoveEvent{.position = {from + i, 24}, .moved = {1, 0}}, kPicture);
            light.update(walk, viewOf(walk));
        }
        EXPECT_GT(light.lightsPreviewed(), 0u);
        const PreviewMethod by = light.previewMethod();
        walk.take(
            ButtonEvent{.button = MouseButton::left, .down = false, .position = {from + 12, 24}},
            kPicture);
        for (int i = 0; i < 1000 && (light.fading() || light.waiting()); ++i) {
            walk.advance(0.02);
            settle(light, walk);
        }
        light.update(walk, viewOf(walk));
        return by;
    };
    EXPECT_EQ(drag(30), PreviewMethod::rays);
    EXPECT_EQ(light.previewMethod(), PreviewMethod::maps);
    EXPECT_NE(light.maps(), nullptr);
    EXPECT_EQ(drag(42), PreviewMethod::maps);
}

TEST_F(WalkLightTest, ARecordedSessionIsThereWhenItEndsAndPlaysAgain) {
    const glm::dvec3 there(0.5, 0.25, 0.5);
    {
        Walkthrough walk(load(file()));
        SessionFile session(walk, file(), file("take.usda"));
        EXPECT_TRUE(std::filesystem::exists(file("take.usda"))) << "at once";
        for (int i = 0; i < 10; ++i) walk.advance(0.05), session.take(walk);
        box(walk).setMatrix(glm::translate(glm::dmat4(1.0), there));
        walk.advance(0.05);
        session.take(walk);
        walk.rig().put({{1, -3, 1}, 0.3, -0.2}, walk.rig().lens());
        walk.advance(0.05);
        session.take(walk);
    } // and is written at the end, whatever the end is
    Walkthrough walk(load(file("take.usda")));
    ASSERT_TRUE(walk.loaded().animation);
    EXPECT_EQ(glm::dvec3(box(walk).matrix()[3]), glm::dvec3(0, 0, 0.5));
    Replay replay(walk, true);
    for (int i = 0; i < 100 && replay.playing(); ++i) replay.advance(walk, 0.02);
    EXPECT_FALSE(replay.playing()) << "it ends";
    EXPECT_LT(glm::distance(glm::dvec3(box(walk).matrix()[3]), there), 1e-12);
    EXPECT_LT(glm::distance(walk.rig().pose().eye, glm::dvec3(1, -3, 1)), 1e-9)
        << "who looks through the camera is taken along";
    replay.toggle(walk);
    replay.advance(walk, 0.1);
    EXPECT_EQ(glm::dvec3(box(walk).matrix()[3]), glm::dvec3(0, 0, 0.5)) << "from the start again";
}

TEST_F(WalkLightTest, ASessionThatCannotBeWrittenSaysSoAtOnce) {
    Walkthrough walk(load(file()));
    EXPECT_THROW(SessionFile(walk, file(), file("no/such/folder.usda")), Error);
}

TEST_F(WalkLightTest, WhoHasMovedAwayFromThePlayedCameraIsLeftAlone) {
    std::ofstream(file("moving.usda"))
        << "#usda 1.0\n(\n    endTimeCode = 48\n    metersPerUnit = 1\n    startTimeCode = 0\n"
           "    subLayers = [@./room.usda@]\n    upAxis = \"Z\"\n)\nover \"Eye\"\n{\n"
           "    double3 xformOp:translate.timeSamples = { 0: (0, -4, 1.5), 48: (2, -4, 1.5) }\n}\n";
    Walkthrough walk(load(file("moving.usda")));
    Replay replay(walk, true);
    replay.advance(walk, 1); // 24 time codes
    EXPECT_NEAR(walk.rig().pose().eye.x, 1, 1e-9);
    const CameraPose aside{{0, -3, 1}, 0, 0};
    walk.rig().put(aside, walk.rig().lens());
    replay.advance(walk, 0.5);
    EXPECT_EQ(walk.rig().pose(), aside);
}

TEST_F(WalkLightTest, TheLayersOfALitFrameAreSavedUnderAFreeName) {
    Walkthrough walk(load(file()));
    WalkLight light(walk, coarse(), makeThreadLink());
    settle(light, walk);
    const std::string stem = freeStem(file("shot"));
    EXPECT_EQ(stem, file("shot-0001"));
    const View view = viewOf(walk);
    saveLayers(stem + ".exr", "room.usda", renderer, light.lit(), view, kPicture);
    EXPECT_GT(std::filesystem::file_size(stem + ".exr"), 1000u);
    EXPECT_EQ(freeStem(file("shot")), file("shot-0002"));
    std::ofstream(file("shot-0002.png")) << "another one";
    EXPECT_EQ(freeStem(file("shot")), file("shot-0003"));
    EXPECT_THROW(
        saveLayers(file("no/folder.exr"), "room.usda", renderer, light.lit(), view, kPicture),
        Error);
}

} // namespace

} // namespace penumbra
