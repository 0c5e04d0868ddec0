// Results never overwrite what is read, nor one another.
#include "Program.h"

#include <gmock/gmock.h>

namespace penumbra {

namespace {

using testing::HasSubstr;

/// A scene of three layers, the lowest of which can't be understood, and a list of sensors.
class Overwrite : public testing::Test {
protected:
    Workplace here;
    std::string broken = here.write("broken.usda", "#usda 1.0\ndef Mesh {");
    std::string walls = here.write("walls.usda", withSubLayer("broken.usda"));
    std::string room = here.write("room.usda", "#usda 1.0\n(\n    subLayers = [@./walls.usda@]\n"
                                               "    metersPerUnit = 1\n    upAxis = \"Z\"\n)\n");
    std::string sensors = here.write("in.csv", "x,y,z,nx,ny,nz\n1,1,0,0,0,1\n");

    static std::string withSubLayer(const std::string& name) {
        std::string text = smallRoom();
        return text.insert(text.find("(\n") + 2, "    subLayers = [@./" + name + "@]\n");
    }
    static Outcome run(std::vector<std::string> arguments) {
        for (const std::string& word : coarse()) arguments.push_back(word);
        return runPenumbra(arguments, {.cpuSeconds = 20});
    }
    /// The program says that the command line is wrong, and leaves `file` as it is.
    static void expectRefused(const std::vector<std::string>& arguments, const std::string& file) {
        const std::string before = readFile(file);
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.exitCode, 2) << testing::PrintToString(arguments) << outcome.err;
        EXPECT_THAT(outcome.err, HasSubstr("would overwrite"));
        EXPECT_EQ(readFile(file), before) << testing::PrintToString(arguments);
    }
    /// No result of any command may be `name`, which is another name of `file`.
    void expectNoResultMayBe(const std::string& name, const std::string& file) {
        expectRefused({"render", room, "-o", name}, file);
        expectRefused({"render", room, "-o", here.path("a.exr"), "--png", name}, file);
        expectRefused({"render", room, "--png", name}, file);
        expectRefused({"render", room, "-o", here.path("a.exr"), "--stats", name}, file);
        expectRefused({"solve", room, "--stats", name}, file);
        expectRefused({"solve", room, "--sensors", sensors, "--values", name}, file);
        expectRefused({"compare", room, "--frames", "1:2", "-o", name}, file);
        expectRefused(
            {"compare", room, "--frames", "1:2", "-o", here.path("a.html"), "--json", name}, file);
    }
};

TEST_F(Overwrite, NoLayerIsReplacedByAResult) {
    for (const std::string& layer : {room, walls, broken}) expectNoResultMayBe(layer, layer);
}

TEST_F(Overwrite, NoLayerIsReplacedUnderAnotherName) {
    namespace fs = std::filesystem;
    fs::create_directory(here.path("sub"));
    fs::create_symlink("../walls.usda", here.path("sub/link"));
    fs::create_symlink("sub/link", here.path("link of a link"));
    fs::create_hard_link(walls, here.path("hard"));
    fs::create_directory_symlink(here.path("."), here.path("sub/up"));
    for (const char* name : {"sub/../walls.usda", "sub/link", "link of a link", "hard",
                             "sub/up/walls.usda", "./walls.usda"})
        expectRefused({"solve", room, "--stats", here.path(name)}, walls);
    expectRefused({"solve", here.path("hard"), "--stats", walls}, walls);
}

TEST_F(Overwrite, NoLayerIsReplacedByAFrameOfItsNumber) {
    const std::string third = here.write("f.0003.usda", smallRoom());
    room = here.write("room.usda", "#usda 1.0\n(\n    subLayers = [@./f.0003.usda@]\n)\n");
    expectRefused({"render", room, "-o", here.path("f.####.usda"), "--frames", "1:4"}, third);
    expectRefused({"solve", room, "--sensors", sensors, "--values", here.path("f.####.usda"),
                   "--frames", "1:4"},
                  third);
}

TEST_F(Overwrite, NoLayerIsReplacedByAPictureOfACamera) {
    const std::string third = here.write("of-Eye.usda", smallRoom());
    room = here.write("room.usda", "#usda 1.0\n(\n    subLayers = [@./of-Eye.usda@]\n)\n");
    expectRefused({"render", room, "--png", here.path("of-{camera}.usda"), "--camera", "/Eye"},
                  third);
}

TEST_F(Overwrite, TheSensorsAreNotReplaced) {
    expectRefused({"solve", room, "--sensors", sensors, "--values", sensors}, sensors);
    expectRefused({"solve", room, "--sensors", sensors, "--values", "-", "--stats", sensors},
                  sensors);
}

TEST_F(Overwrite, NoTwoResultsHaveOnePlace) {
    const std::string one = here.path("one");
    std::filesystem::create_symlink("one", here.path("link")); // to what is not there yet
    expectRefused({"render", room, "-o", one, "--png", one}, one);
    expectRefused({"render", room, "-o", one, "--stats", here.path("link")}, one);
    expectRefused(
        {"render", room, "-o", here.path("a#.x"), "--png", here.path("a##.x"), "--frames", "9:10"},
        one);
    expectRefused({"solve", room, "--sensors", sensors, "--values", one, "--stats", one}, one);
    expectRefused({"compare", room, "--frames", "1:2", "-o", one, "--json", one}, one);
    EXPECT_FALSE(std::filesystem::exists(one));
}

TEST_F(Overwrite, WhatIsNoLayerMayBeReplaced) {
    const std::string old = here.write("old.json", "something else");
    EXPECT_EQ(run({"solve", room, "--stats", old}).exitCode, 0);
    EXPECT_THAT(readFile(old), HasSubstr("certificate"));
    EXPECT_EQ(
        run({"solve", room, "--stats", "/dev/null", "--sensors", sensors, "--values", "/dev/null"})
            .exitCode,
        0);
}

} // namespace

} // namespace penumbra
