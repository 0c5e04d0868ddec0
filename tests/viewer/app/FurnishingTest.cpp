// What is removed, hidden and duplicated in a walkthrough, and the layer that says so.
#include "viewer/input/Furnishing.h"

#include "scenegraph/Find.h"
#include "scenegraph/Mesh.h"
#include "tests/support/TemporaryFolder.h"
#include "viewer/app/EditsFile.h"
#include "viewer/app/SessionFile.h"
#include "viewer/input/Walkthrough.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <random>

namespace penumbra {

namespace {

constexpr const char* kRoom = R"(#usda 1.0
(
    defaultPrim = "World"
    metersPerUnit = 0.01
    upAxis = "Z"
)
def Xform "World"
{
    def Scope "Looks"
    {
        def Material "Wood"
        {
            token outputs:surface.connect = </World/Looks/Wood/Surface.outputs:surface>
            def Shader "Surface"
            {
                uniform token info:id = "UsdPreviewSurface"
                color3f inputs:diffuseColor = (0.6, 0.4, 0.2)
                token outputs:surface
            }
        }
    }
    def Mesh "Floor"
    {
        point3f[] points = [(-500, -500, 0), (500, -500, 0), (500, 500, 0), (-500, 500, 0)]
        int[] faceVertexCounts = [4]
        int[] faceVertexIndices = [0, 1, 2, 3]
    }
    def Xform "Desk" (kind = "component")
    {
        double3 xformOp:translate = (100, 0, 40)
        uniform token[] xformOpOrder = ["xformOp:translate"]
        def Cube "Top"
        {
            double size = 60
            rel material:binding = </World/Looks/Wood>
        }
        def Xform "Lamp"
        {
            bool penumbra:movable = true
            double3 xformOp:translate = (0, 0, 60)
            uniform token[] xformOpOrder = ["xformOp:translate"]
            def SphereLight "Bulb"
            {
                float inputs:radius = 5
                float inputs:intensity = 300
            }
        }
    }
    def Cube "Seat"
    {
        bool penumbra:movable = true
        double size = 40
        color3f[] primvars:displayColor = [(0.5, 0.1, 0.1)]
        double3 xformOp:translate.timeSamples = { 1: (-100, 0, 20), 5: (-100, 50, 20) }
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }
    def Cube "Guest"
    {
        token visibility.timeSamples = { 1: "inherited", 5: "invisible" }
        double size = 30
        double3 xformOp:translate = (0, 200, 15)
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }
}
)";

/// What is there to be seen, a line a thing with its object, sorted.
std::vector<std::string> seenIn(const Scene& scene) {
    const PlacedScene placed = placeScene(scene);
    std::vector<std::string> lines;
    const auto add = [&](const auto& thing, const char* kind, Rgb colour) {
        if (!placed.objects[thing.object.value].visible) return;
        std::string line = kind + (" of " + placed.objects[thing.object.value].path);
        char number[32];
        for (int c = 0; c < 4; ++c)
            for (int r = 0; r < 3; ++r) {
                std::snprintf(number, sizeof number, " %.5f", thing.toWorld[c][r] + 1e-12);
                line += number;
            }
        std::snprintf(number, sizeof number, " %.4g %.4g", double(colour.r), double(colour.g));
        lines.push_back(line + number);
    };
    for (const auto& mesh : placed.meshes)
        add(mesh, "mesh", mesh.node->materialOf(0)->reflectance());
    for (const auto& light : placed.lights) add(light, "light", light.node->luminance());
    std::sort(lines.begin(), lines.end());
    return lines;
}

class Furnishing : public testing::Test {
protected:
    Furnishing() {
        folder.write("room.usda", kRoom);
        file = folder.file("room.usda");
    }
    Walkthrough walkthrough() const {
        ReadyScene ready;
        ready.loaded = loadUsdScene(file);
        ready.placed = placeScene(*ready.loaded.scene);
        ready.rays = std::make_unique<SceneRays>(ready.placed);
        return Walkthrough(std::move(ready));
    }
    static void select(Walkthrough& walk, std::uint32_t object) {
        Touch touch;
        touch.object = {object};
        touch.path = walk.placed().objects[object].path;
        walk.select(selectionOf(walk.scene(), walk.placed(), touch));
    }
    static bool select(Walkthrough& walk, const std::string& path) {
        for (std::uint32_t o = 0; o < walk.placed().objects.size(); ++o)
            if (walk.placed().objects[o].path == path) {
                select(walk, o);
                return true;
            }
        return false;
    }
    LoadedScene saved(const Walkthrough& walk) {
        const auto layer = folder.file("room-edited.usda");
        EXPECT_TRUE(saveEdits(walk.loaded(), file, walk.history(), layer).empty());
        LoadedScene again = loadUsdScene(layer);
        EXPECT_TRUE(again.diagnostics.empty()) << again.diagnostics.front().line();
        return again;
    }

    TemporaryFolder folder;
    std::filesystem::path file;
};

TEST_F(Furnishing, WhatIsRemovedIsGoneAndComesBackToItsPlace) {
    Walkthrough walk = walkthrough();
    const auto before = seenIn(walk.scene());
    ASSERT_TRUE(select(walk, "/World/Desk"));
    const auto place = placeOf(walk.scene().root, "/World/Desk", *walk.selection()->node);
    ASSERT_TRUE(place);
    walk.perform({Action::remove});
    EXPECT_FALSE(walk.selection());
    EXPECT_EQ(seenIn(walk.scene()).size(), before.size() - 2) << "its light goes with it";
    EXPECT_FALSE(select(walk, "/World/Desk"));
    EXPECT_EQ(seenIn(*saved(walk).scene), seenIn(walk.scene()));
    walk.perform({Action::undo});
    EXPECT_EQ(seenIn(walk.scene()), before);
    EXPECT_EQ(place->parent->children()[place->index]->name(), "Desk");
    walk.perform({Action::redo});
    EXPECT_EQ(seenIn(walk.scene()).size(), before.size() - 2);
}

TEST_F(Furnishing, WhatIsHiddenIsShownAgainAllAtOnceInItsOrder) {
    Walkthrough walk = walkthrough();
    const auto before = seenIn(walk.scene());
    const auto names = [&] {
        std::vector<std::string> all;
        for (const Object& object : walk.placed().objects) all.push_back(object.path);
        return all;
    };
    const auto order = names();
    for (const char* path : {"/World/Desk", "/World/Seat"}) {
        ASSERT_TRUE(select(walk, path));
        walk.perform({Action::hide});
    }
    EXPECT_EQ(walk.history().hidden().size(), 2u);
    const LoadedScene again = saved(walk);
    EXPECT_EQ(seenIn(*again.scene), seenIn(walk.scene()));
    walk.perform({Action::showHidden});
    EXPECT_TRUE(walk.history().hidden().empty());
    EXPECT_EQ(seenIn(walk.scene()), before);
    EXPECT_EQ(names(), order);
    walk.perform({Action::undo});
    EXPECT_EQ(walk.history().hidden().size(), 2u);
}

TEST_F(Furnishing, AnotherOneStandsBesideItAndIsEditedByItself) {
    Walkthrough walk = walkthrough();
    ASSERT_TRUE(select(walk, "/World/Desk"));
    const auto desk = walk.selection()->node;
    walk.perform({Action::duplicate});
    ASSERT_TRUE(walk.selection());
    EXPECT_EQ(walk.selection()->objectPath, "/World/Desk_copy");
    EXPECT_TRUE(walk.selection()->node->beginsObject());
    const glm::dmat4 now = walk.placed().objects[walk.selection()->object.value].toWorld;
    EXPECT_NEAR(std::abs(now[3].x - 1.0) + std::abs(now[3].y), 0.65, 1e-5) << "60 cm and a gap";
    ASSERT_TRUE(select(walk, "/World/Desk_copy/Lamp"));
    ASSERT_EQ(walk.selection()->lights.size(), 1u);
    walk.perform({Action::dimmer});
    const auto bulb = findAt<Light>(*walk.scene().root, "/World/Desk/Lamp/Bulb");
    EXPECT_EQ(bulb->luminance(), Rgb(300)) << "the light of the first";
    EXPECT_LT(walk.selection()->lights[0]->luminance().r, 290);
    EXPECT_EQ(seenIn(*saved(walk).scene), seenIn(walk.scene()));
    ASSERT_TRUE(select(walk, "/World/Desk_copy"));
    walk.perform({Action::duplicate});
    EXPECT_EQ(walk.selection()->objectPath, "/World/Desk_copy2");
    EXPECT_EQ(seenIn(*saved(walk).scene), seenIn(walk.scene()));
    ASSERT_TRUE(select(walk, "/World/Desk"));
    walk.perform({Action::remove});
    EXPECT_EQ(seenIn(*saved(walk).scene), seenIn(walk.scene())) << "copies stay";
}

TEST_F(Furnishing, OfAThingThatWasTakenBackNothingStaysSelected) {
    Walkthrough walk = walkthrough();
    ASSERT_TRUE(select(walk, "/World/Seat"));
    walk.perform({Action::duplicate});
    walk.perform({Action::undo});
    EXPECT_FALSE(walk.selection());
    for (const Action action : {Action::remove, Action::hide, Action::duplicate, Action::frame})
        walk.perform({action});
    EXPECT_EQ(walk.history().undoable(), 0u);
}

TEST_F(Furnishing, AnySequenceIsTakenBackAndSavedAsItIsSeen) {
    constexpr int kSequences = 400, kEdits = 12;
    constexpr Action kActions[] = {Action::remove,    Action::hide,   Action::duplicate,
                                   Action::duplicate, Action::nudge,  Action::nudge,
                                   Action::turnLeft,  Action::dimmer, Action::showHidden,
                                   Action::undo,      Action::redo};
    for (int seed = 0; seed < kSequences; ++seed) {
        std::mt19937 random{unsigned(seed)};
        Walkthrough walk = walkthrough();
        const auto before = seenIn(walk.scene());
        std::string what = "sequence " + std::to_string(seed) + ":";
        for (int i = 0; i < kEdits; ++i) {
            const auto objects = std::uint32_t(walk.placed().objects.size());
            const Action action = kActions[random() % std::size(kActions)];
            if (objects > 0) {
                const std::uint32_t object = std::uint32_t(random()) % objects;
                const bool floor = walk.placed().objects[object].path == "/World";
                if (!floor) select(walk, object);
                what.append(" ").append(walk.placed().objects[object].path);
            }
            what.append(" ").append(std::to_string(int(action)));
            walk.perform({action, int(random() % 6), true});
            walk.advance(1);
        }
        ASSERT_EQ(seenIn(*saved(walk).scene), seenIn(walk.scene())) << what;
        while (walk.history().undoable() > 0) walk.perform({Action::undo});
        ASSERT_EQ(seenIn(walk.scene()), before) << what;
    }
}

TEST_F(Furnishing, IsReplayedAtItsTime) {
    Walkthrough walk = walkthrough();
    const auto layer = folder.file("take.usda");
    std::vector<std::vector<std::string>> seen;
    {
        SessionFile session(walk, file, layer);
        const auto step = [&](const char* path, Action action) {
            if (path) {
                ASSERT_TRUE(select(walk, path));
            }
            walk.perform({action, 0, true});
            seen.push_back(seenIn(walk.scene()));
            session.take(walk);
            walk.advance(1);
            session.take(walk);
        };
        step("/World/Seat", Action::nudge);
        step("/World/Desk", Action::duplicate);
        step(nullptr, Action::nudge);
        step("/World/Desk", Action::remove);
        step(nullptr, Action::undo);
        step("/World/Desk_copy", Action::hide);
    }
    const LoadedScene replay = loadUsdScene(layer);
    ASSERT_TRUE(replay.diagnostics.empty()) << replay.diagnostics.front().line();
    ASSERT_TRUE(replay.animation);
    for (std::size_t s = 0; s < seen.size(); ++s) {
        replay.animation->setTime(1 + (double(s) + 0.5) * UsdRecording::kRate);
        EXPECT_EQ(seenIn(*replay.scene), seen[s]) << "step " << s;
    }
}

} // namespace

} // namespace penumbra
