// The animated layers of scenes/: what moves in them, and that nothing else does.
#include "tests/io/usd/UsdTestFiles.h"

#include "scenegraph/Objects.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace penumbra {

namespace {

using Paths = std::set<std::string>;

struct Walkthrough {
    const char* layer;
    const char* scene;
    Paths objects; ///< that move
    Paths lights;  ///< that are dimmed, recoloured or switched
    Paths cameras; ///< that move
};

void PrintTo(const Walkthrough& walkthrough, std::ostream* out) {
    *out << walkthrough.layer;
}

LoadedScene load(const std::string& name, const LoadOptions& options = {}) {
    return loadUsdScene(std::filesystem::path(PENUMBRA_SOURCE_DIR) / "scenes" / (name + ".usda"),
                        options);
}

template <class T>
Paths whereDifferent(const std::vector<T>& a, const std::vector<T>& b) {
    Paths paths;
    for (std::size_t i = 0; i < a.size(); ++i)
        if (a[i].path != b.at(i).path || a[i].toWorld != b[i].toWorld) paths.insert(a[i].path);
    return paths;
}

Paths relit(const std::vector<Placed<Light>>& placed, const std::vector<Rgb>& before) {
    Paths paths;
    for (std::size_t i = 0; i < placed.size(); ++i)
        if (placed[i].node->luminance() != before.at(i)) paths.insert(placed[i].path);
    return paths;
}

std::vector<Rgb> luminances(const PlacedScene& placed) {
    std::vector<Rgb> values;
    for (const auto& light : placed.lights) values.push_back(light.node->luminance());
    return values;
}

double distance(const glm::dmat4& a, const glm::dmat4& b) {
    return glm::length(glm::dvec3(a[3] - b[3]));
}

// Of the turn from a to b, both without scale [degrees].
double angle(const glm::dmat4& a, const glm::dmat4& b) {
    const glm::dmat3 turn = glm::dmat3(b) * glm::transpose(glm::dmat3(a));
    const double cosine = (turn[0][0] + turn[1][1] + turn[2][2] - 1) / 2;
    return glm::degrees(std::acos(std::clamp(cosine, -1.0, 1.0)));
}

double difference(const glm::dmat4& a, const glm::dmat4& b) {
    double most = 0;
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r) most = std::max(most, std::abs(a[c][r] - b[c][r]));
    return most;
}

class Walkthroughs : public testing::TestWithParam<Walkthrough> {
protected:
    /// Calls visit(frame, placed scene) at each frame.
    template <class Visit>
    void play(const Visit& visit) const {
        for (int frame = first(); frame <= last(); ++frame) {
            loaded_.animation->setTime(frame);
            visit(frame, placeScene(*loaded_.scene));
        }
    }
    int first() const { return int(loaded_.scene->startTimeCode); }
    int last() const { return int(loaded_.scene->endTimeCode); }

    const LoadedScene base_ = load(GetParam().scene);
    const LoadedScene loaded_ = load(GetParam().layer);
};

const Walkthrough kAll[] = {
    {"chamber-move", "chamber", {"/World/TallBox"}, {}, {}},
    {"office-seat", "office", {"/World/Seat"}, {}, {}},
    {"office-lamp", "office", {"/World/DeskLamp"}, {"/World/DeskLamp/Bulb"}, {}},
    {"office-ceiling", "office", {"/World/CeilingLamp2"}, {"/World/CeilingLamp2/Panel"}, {}},
    {"gallery-walk",
     "gallery",
     {"/World/Head", "/World/PiercedCube", "/World/Plinth6", "/World/Spot2"},
     {},
     {"/World/Camera"}},
};

std::string nameOf(const testing::TestParamInfo<Walkthrough>& info) {
    std::string name = info.param.layer;
    name.erase(std::remove(name.begin(), name.end(), '-'), name.end());
    return name;
}

} // namespace

TEST_P(Walkthroughs, HaveAFewDozenFramesAndLoadWithoutAWarning) {
    ASSERT_TRUE(loaded_.animation);
    EXPECT_EQ(first(), 1);
    EXPECT_GE(last(), 24);
    EXPECT_LE(last(), 49);
    for (const Diagnostic& diagnostic : loaded_.diagnostics) ADD_FAILURE() << diagnostic.line();
}

TEST_P(Walkthroughs, BeginAsTheSceneIs) {
    const PlacedScene still = placeScene(*base_.scene);
    const PlacedScene placed = placeScene(*loaded_.scene);
    ASSERT_EQ(placed.objects.size(), still.objects.size());
    for (std::size_t i = 0; i < still.objects.size(); ++i) {
        EXPECT_EQ(placed.objects[i].path, still.objects[i].path);
        EXPECT_LT(difference(placed.objects[i].toWorld, still.objects[i].toWorld), 1e-9);
    }
    EXPECT_THAT(relit(placed.lights, luminances(still)), testing::IsEmpty());
    EXPECT_THAT(whereDifferent(placed.cameras, still.cameras), testing::IsEmpty());
}

TEST_P(Walkthroughs, MoveWhatTheySayAndNothingElse) {
    const PlacedScene start = placeScene(*loaded_.scene);
    const std::vector<Rgb> lit = luminances(start);
    Paths objects, lights, cameras;
    play([&](int, const PlacedScene& placed) {
        objects.merge(whereDifferent(start.objects, placed.objects));
        lights.merge(relit(placed.lights, lit));
        cameras.merge(whereDifferent(start.cameras, placed.cameras));
    });
    EXPECT_EQ(objects, GetParam().objects);
    EXPECT_EQ(lights, GetParam().lights);
    EXPECT_EQ(cameras, GetParam().cameras);
}

TEST_P(Walkthroughs, WhatMovesIsOneObjectOfTheScene) {
    const PlacedScene still = placeScene(*base_.scene);
    for (const std::string& path : GetParam().objects) {
        const auto named = [&](const Object& object) { return object.path == path; };
        const auto below = [&](const Object& object) {
            return object.path.starts_with(path + "/");
        };
        const auto found = std::find_if(still.objects.begin(), still.objects.end(), named);
        ASSERT_NE(found, still.objects.end()) << path;
        EXPECT_TRUE(std::none_of(still.objects.begin(), still.objects.end(), below)) << path;
    }
}

TEST_P(Walkthroughs, PartsAndLightsGoAlongWithTheirObject) {
    const PlacedScene start = placeScene(*loaded_.scene);
    const auto rigid = [&](const auto& parts, const auto& placed, const auto& objects) {
        for (std::size_t i = 0; i < parts.size(); ++i) {
            const auto& from = start.objects[parts[i].object.value];
            const auto& to = objects[placed[i].object.value];
            ASSERT_LT(difference(glm::inverse(from.toWorld) * parts[i].toWorld,
                                 glm::inverse(to.toWorld) * placed[i].toWorld),
                      1e-9)
                << parts[i].path;
        }
    };
    play([&](int, const PlacedScene& placed) {
        rigid(start.meshes, placed.meshes, placed.objects);
        rigid(start.lights, placed.lights, placed.objects);
    });
}

TEST_P(Walkthroughs, NothingJumpsBetweenTwoFrames) {
    // Limits at the speed of a hand and of a walk; see scenes/scenegen/check_motion.py.
    PlacedScene before = placeScene(*loaded_.scene);
    const auto expectNear = [](const auto& a, const auto& b, double metres, double degrees) {
        for (std::size_t i = 0; i < a.size(); ++i) {
            EXPECT_LT(distance(a[i].toWorld, b[i].toWorld), metres) << a[i].path;
            EXPECT_LT(angle(a[i].toWorld, b[i].toWorld), degrees) << a[i].path;
        }
    };
    play([&](int, const PlacedScene& placed) {
        expectNear(before.objects, placed.objects, 0.15, 12);
        expectNear(before.cameras, placed.cameras, 0.30, 6);
        before = placed;
    });
}

TEST_P(Walkthroughs, AreTheSamePlayedAndLoadedAtAFrame) {
    play([&](int frame, const PlacedScene& played) {
        const LoadedScene fresh = load(GetParam().layer, {.time = frame});
        const PlacedScene placed = placeScene(*fresh.scene);
        EXPECT_THAT(whereDifferent(played.objects, placed.objects), testing::IsEmpty()) << frame;
        EXPECT_THAT(relit(placed.lights, luminances(played)), testing::IsEmpty()) << frame;
    });
}

INSTANTIATE_TEST_SUITE_P(Scenes, Walkthroughs, testing::ValuesIn(kAll), nameOf);

TEST(ChamberMove, MovesInEveryFrame) {
    const LoadedScene loaded = load("chamber-move");
    PlacedScene before = placeScene(*loaded.scene);
    for (double frame = 2; frame <= loaded.scene->endTimeCode; ++frame) {
        loaded.animation->setTime(frame);
        const PlacedScene placed = placeScene(*loaded.scene);
        EXPECT_EQ(whereDifferent(before.objects, placed.objects), Paths{"/World/TallBox"}) << frame;
        before = placed;
    }
}

TEST(OfficeLight, IsDimmedAndRecolouredWhileItStandsStill) {
    // Frames 21 to 35: edits of a light alone, which need no form factor and no ray.
    const LoadedScene loaded = load("office-lamp", {.time = 21});
    const PlacedScene start = placeScene(*loaded.scene);
    const std::vector<Rgb> lit = luminances(start);
    loaded.animation->setTime(35);
    const PlacedScene placed = placeScene(*loaded.scene);
    EXPECT_THAT(whereDifferent(start.objects, placed.objects), testing::IsEmpty());
    ASSERT_EQ(relit(placed.lights, lit), Paths{"/World/DeskLamp/Bulb"});
    const auto bulb = std::find_if(placed.lights.begin(), placed.lights.end(),
                                   [](const auto& l) { return l.path == "/World/DeskLamp/Bulb"; });
    const Rgb before = lit.at(std::size_t(bulb - placed.lights.begin()));
    const Rgb after = bulb->node->luminance();
    EXPECT_LT(luminance(after), 0.3f * luminance(before));
    EXPECT_GT(after.b / after.r, 2 * before.b / before.r); // from 3000 K to 5600 K
}

TEST(OfficeCeiling, IsSwitchedOffAndOnAgain) {
    const LoadedScene loaded = load("office-ceiling");
    const auto nits = [&](double frame) {
        loaded.animation->setTime(frame);
        const auto nodes = nodesByPath(*loaded.scene);
        return luminance(leafOf(nodes, "/World/CeilingLamp2/Panel")->light()->luminance());
    };
    EXPECT_NEAR(nits(27), 2400, 1);
    EXPECT_EQ(nits(28), 0);
    EXPECT_EQ(nits(35), 0);
    EXPECT_NEAR(nits(36), 1200, 1);
    EXPECT_NEAR(nits(48), 2400, 1);
}

} // namespace penumbra
