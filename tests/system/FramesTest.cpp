// Playing a file's animation: numbered results, what each frame costs, the same light as alone.
#include "Program.h"

#include "tests/support/Command.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <sstream>

namespace penumbra {

namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

void replace(std::string& text, const std::string& from, const std::string& to) {
    ASSERT_NE(text.find(from), std::string::npos) << from;
    text.replace(text.find(from), from.size(), to);
}

/// The small room; its box moves until frame 3, its light is dimmed at frame 4.
std::string playedRoom() {
    std::string room = smallRoom();
    replace(room, "xformOp:translate = (1.1, 1.2, 0.3)",
            "xformOp:translate.timeSamples = { 1: (1.1, 1.2, 0.3), 3: (0.5, 0.6, 0.4) }");
    replace(room, "inputs:intensity = 100", "inputs:intensity.timeSamples = { 3: 100, 4: 50 }");
    return room;
}

class Frames : public testing::Test {
protected:
    Workplace here;
    std::string room = here.write("room.usda", playedRoom());
    std::string sensors =
        here.write("in.csv", "x,y,z,nx,ny,nz\n0.4,0.4,0,0,0,1\n1.6,0.3,0,0,0,1\n0,1,1,1,0,0\n");

    Outcome run(const std::string& command, std::vector<std::string> more) const {
        std::vector<std::string> arguments{command, room, "--quiet"};
        for (const std::string& word : coarse()) arguments.push_back(word);
        arguments.insert(arguments.end(), more.begin(), more.end());
        return runPenumbra(arguments);
    }
    /// Solves; `out` names the files of values and statistics.
    nlohmann::json solve(const std::string& out, std::vector<std::string> more) const {
        more.insert(more.end(), {"--sensors", sensors, "--values", here.path(out + ".csv"),
                                 "--stats", here.path("stats.json")});
        const Outcome outcome = run("solve", more);
        EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
        return nlohmann::json::parse(readFile(here.path("stats.json")));
    }
    /// Green illuminance at the sensors [lux].
    std::vector<double> values(const std::string& file) const {
        std::vector<double> column;
        std::istringstream text(readFile(here.path(file + ".csv")));
        std::string line, cell;
        std::getline(text, line);
        while (std::getline(text, line)) {
            std::istringstream cells(line);
            for (int i = 0; i < 8; ++i) std::getline(cells, cell, ',');
            column.push_back(std::stod(cell));
        }
        EXPECT_EQ(column.size(), 3u) << file;
        return column;
    }
};

TEST_F(Frames, AreNumberedInThePlaceOfTheSigns) {
    const std::vector<std::string> small{"--width", "32", "--height", "18", "--frames", "1:3"};
    std::vector<std::string> more{"-o", here.path("a.####.exr"), "--png", here.path("b#.png")};
    more.insert(more.end(), small.begin(), small.end());
    const Outcome outcome = run("render", more);
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_THAT(outcome.out + outcome.err, IsEmpty());
    EXPECT_THAT(here.files(), ElementsAre("a.0001.exr", "a.0002.exr", "a.0003.exr", "b1.png",
                                          "b2.png", "b3.png", "in.csv", "room.usda"));
    EXPECT_NE(readFile(here.path("a.0001.exr")), readFile(here.path("a.0002.exr")));
}

TEST_F(Frames, WriteTheValuesOfTheLastUnlessTheyAreNumbered) {
    solve("last", {"--frames", "1:3"});
    solve("each##", {"--frames", "1:3"});
    EXPECT_THAT(here.files(), ElementsAre("each01.csv", "each02.csv", "each03.csv", "in.csv",
                                          "last.csv", "room.usda", "stats.json"));
    EXPECT_EQ(values("last"), values("each03"));
    EXPECT_NE(values("each01"), values("each03"));
}

TEST_F(Frames, AreMeshedAlikeWhicheverOfThemOneBeginsWith) {
    // A box that grows: sizes that follow the scene are those of its start.
    std::string growing = smallRoom();
    replace(growing, "metersPerUnit = 1", "metersPerUnit = 1\n    startTimeCode = 1");
    replace(growing, "double size = 0.6",
            "double size = 0.6\n    float3 xformOp:scale.timeSamples = { 1: (1, 1, 1), "
            "3: (2.5, 2.5, 2.5) }");
    replace(growing, "[\"xformOp:translate\"]", "[\"xformOp:translate\", \"xformOp:scale\"]");
    const std::string file = here.write("growing.usda", growing);
    const auto sizeWith = [&](const std::string& option, const std::string& frames) {
        const Outcome outcome =
            runPenumbra({"solve", file, "--quiet", "--direct-only", "--samples", "1", option,
                         frames, "--stats", here.path("stats.json")});
        EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
        const auto scene = nlohmann::json::parse(readFile(here.path("stats.json"))).at("scene");
        return std::pair(scene.at("patch_size").get<double>(),
                         scene.at("element_size").get<double>());
    };
    const auto played = sizeWith("--frames", "1:3");
    EXPECT_EQ(sizeWith("--frame", "3"), played);
    EXPECT_EQ(sizeWith("--frames", "2:3"), played);
}

TEST_F(Frames, ThatMakeNoSenseAreAWrongCommandLine) {
    for (const char* frames : {"3:1", "1:", ":2", "a:b", "1:2:3", "1-3", "1.5:2"}) {
        const Outcome outcome = run("solve", {"--frames", frames});
        EXPECT_EQ(outcome.exitCode, 2) << frames;
        EXPECT_THAT(outcome.err, HasSubstr("--frames")) << frames;
        EXPECT_THAT(outcome.err, HasSubstr(frames));
        EXPECT_THAT(outcome.err, HasSubstr("A:B"));
    }
}

TEST_F(Frames, ThatNeverEndAreAWrongCommandLine) {
    for (const char* frames : {"2147483640:2147483647", "-2147483648:2147483647", "1:2147483646",
                               "-2147483648:-2147483647", "1:100001", "1:99999999999"}) {
        const Outcome outcome = run(
            "solve", {"--frames", frames, "--sensors", sensors, "--values", here.path("v.#.csv")});
        EXPECT_EQ(outcome.exitCode, 2) << frames;
        EXPECT_THAT(outcome.err, HasSubstr("--frames")) << frames;
        EXPECT_THAT(outcome.err, HasSubstr(frames));
    }
    EXPECT_THAT(here.files(), ElementsAre("in.csv", "room.usda"));
    solve("v", {"--frames", "999999999:1000000000"});
    EXPECT_EQ(
        run("render", {"-o", here.path("a#.exr"), "--frames", "-2147483648:2147483647"}).exitCode,
        2);
}

TEST_F(Frames, ThatWouldOverwriteEachOtherAreAWrongCommandLine) {
    const Outcome outcome = run("render", {"-o", here.path("a.exr"), "--frames", "1:2"});
    EXPECT_EQ(outcome.exitCode, 2);
    EXPECT_THAT(outcome.err, HasSubstr("frame.####.exr"));
    EXPECT_THAT(here.files(), ElementsAre("in.csv", "room.usda"));
}

TEST_F(Frames, HaveStatisticsWithTheKeysOfTheContract) {
    const auto frames = solve("v", {"--frames", "1:5"}).at("frames");
    ASSERT_EQ(frames.size(), 5u);
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const auto& frame = frames[i];
        EXPECT_EQ(frame.at("frame"), i + 1);
        for (const char* key : {"edits", "rays", "rays_full", "rays_single", "entries_changed",
                                "shots", "certificate", "seconds"})
            EXPECT_GE(frame.at(key), 0) << key;
        EXPECT_EQ(frame.at("state"), "exact");
        EXPECT_EQ(frame.at("rays"),
                  frame.at("rays_full").get<int>() + frame.at("rays_single").get<int>());
        for (const char* key : {"rays", "rays_full", "rays_single", "entries_changed"})
            EXPECT_EQ(frame.at(key), frame.at("direct").at(key).get<int>() +
                                         frame.at("indirect").at(key).get<int>())
                << key;
    }
    EXPECT_EQ(frames[1].at("edits"), 1);
    EXPECT_GT(frames[1].at("entries_changed"), 0);
    EXPECT_LT(frames[1].at("rays"), frames[0].at("rays")) << "a move";
    EXPECT_GE(frames[3].at("edits"), 1); // its emitters, and its colour
    EXPECT_EQ(frames[3].at("rays"), 0) << "a light is dimmed";
    EXPECT_EQ(frames[4].at("edits"), 0);
    EXPECT_EQ(frames[4].at("shots"), 0) << "nothing happens";
    EXPECT_FALSE(solve("v", {"--frame", "2"}).contains("frames"));
}

TEST_F(Frames, AreLitAsTheyAreAlone) {
    const auto played = solve("played#", {"--frames", "1:4"});
    solve("anew#", {"--frames", "1:4", "--from-scratch"});
    for (const int frame : {1, 2, 3, 4}) {
        const std::string number = std::to_string(frame);
        const auto alone = solve("alone", {"--frame", number});
        // What a point receives is wrong by no more than what the surfaces send is.
        const double bound = alone.at("solve").at("certificate").get<double>() +
                             played.at("frames").at(frame - 1).at("certificate").get<double>() +
                             1e-3;
        for (const std::string& file : {"played" + number, "anew" + number})
            EXPECT_THAT(values(file),
                        testing::Pointwise(testing::DoubleNear(bound), values("alone")))
                << file;
        EXPECT_EQ(values("anew" + number), values("alone"));
    }
}

TEST_F(Frames, FromScratchForgetEverythingEachTime) {
    const auto stats = solve("v", {"--frames", "1:3", "--from-scratch"});
    const auto& frames = stats.at("frames");
    ASSERT_EQ(frames.size(), 3u);
    std::uint64_t rays = 0, shots = 0;
    for (const auto& frame : frames) {
        EXPECT_EQ(frame.at("rebuilt"), true);
        EXPECT_GT(frame.at("rays"), frames[0].at("rays").get<int>() / 2);
        rays += frame.at("rays").get<std::uint64_t>();
        shots += frame.at("shots").get<std::uint64_t>();
    }
    EXPECT_EQ(stats.at("solve").at("rays"), rays) << "of all frames, as those of updates are";
    EXPECT_EQ(stats.at("solve").at("shots"), shots);
}

TEST_F(Frames, ThatFadeLeaveTheDark) {
    // A light that is a mesh: no headlight stands in for it once it is out.
    std::string fading = smallRoom();
    replace(fading, "RectLight", "CylinderLight");
    replace(fading, "inputs:intensity = 100", "inputs:intensity.timeSamples = { 1: 100, 2: 0 }");
    room = here.write("room.usda", fading);
    const Outcome outcome = run("render", {"--width", "32", "--height", "18", "--frames", "1:2",
                                           "-o", here.path("a#.exr")});
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    const auto brightest = [&](const std::string& file) {
        return outputOf("oiiotool " + here.path(file) + " --ch G --printstats");
    };
    if (brightest("a1.exr").empty()) GTEST_SKIP() << "oiiotool is not here";
    EXPECT_THAT(brightest("a1.exr"), testing::Not(HasSubstr("Stats Max: 0.000000")));
    EXPECT_THAT(brightest("a2.exr"), HasSubstr("Stats Max: 0.000000"));
}

/// The box has a scale at frame 2, and is as it was at frame 3.
std::string growingRoom(const std::string& scale) {
    std::string growing = smallRoom();
    replace(growing, "double size = 0.6",
            "double size = 0.6\n    float3 xformOp:scale.timeSamples = { 1: (1, 1, 1), 2: " +
                scale + ", 3: (1, 1, 1) }");
    replace(growing, "[\"xformOp:translate\"]", "[\"xformOp:translate\", \"xformOp:scale\"]");
    return growing;
}

TEST_F(Frames, KeepTheNumbersOfObjects) {
    room = here.write("room.usda", growingRoom("(1.5, 1, 1)"));
    const Outcome outcome = run("render", {"--width", "64", "--height", "36", "--frames", "1:3",
                                           "--direct-only", "-o", here.path("a#.exr")});
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    if (outputOf("command -v oiiotool").empty()) GTEST_SKIP() << "oiiotool is not here";
    EXPECT_THAT(outputOf("oiiotool --diff " + here.path("a1.exr") + " " + here.path("a3.exr")),
                HasSubstr("PASS"))
        << "all layers, numbers of objects among them";
}

TEST_F(Frames, ThatCantBeMeshedAreRefusedWithTheFile) {
    room = here.write("room.usda", growingRoom("(9e6, 9e6, 1)"));
    const Outcome outcome = run("solve", {"--frames", "1:2", "--direct-only"});
    EXPECT_EQ(outcome.exitCode, 1);
    EXPECT_THAT(outcome.err, HasSubstr("room.usda: error: "));
}

TEST_F(Frames, OfASceneWithoutAnimationAreSaidToBeAlike) {
    const std::string still = here.write("still.usda", smallRoom());
    for (const char* option : {"--frames", "--frame"}) {
        const Outcome outcome =
            runPenumbra({"solve", still, "--direct-only", "--samples", "1", option,
                         option == std::string("--frame") ? "2" : "1:2"});
        EXPECT_EQ(outcome.exitCode, 0);
        EXPECT_THAT(outcome.err, HasSubstr("nothing in it moves"));
    }
}

} // namespace

} // namespace penumbra
