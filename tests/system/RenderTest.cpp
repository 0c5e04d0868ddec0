// penumbra render: a scene becomes a picture that others can read.
#include "Program.h"
#include "tests/support/Command.h"

#include <gmock/gmock.h>

#include <array>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace penumbra {

namespace {

using testing::ContainsRegex;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class Render : public testing::Test {
protected:
    Workplace here;
    std::string room = here.write("room.usda", smallRoom());

    Outcome render(const std::string& output, std::vector<std::string> more = {}) {
        return run({"-o", here.path(output)}, std::move(more));
    }
    Outcome png(const std::string& output, std::vector<std::string> more = {}) {
        return run({"--png", here.path(output)}, std::move(more));
    }
    Outcome run(const std::vector<std::string>& output, std::vector<std::string> more) {
        std::vector<std::string> arguments{"render", room, "--width", "64", "--height", "36"};
        arguments.insert(arguments.end(), output.begin(), output.end());
        for (const std::string& word : coarse()) arguments.push_back(word);
        arguments.insert(arguments.end(), more.begin(), more.end());
        return runPenumbra(arguments);
    }
    /// What oiiotool says of a picture, or of a part of it.
    std::string statistics(const std::string& file, const std::string& part = "") {
        return outputOf("oiiotool " + here.path(file) + part + " --printstats");
    }
};

/// Two more cameras, of one name, for smallRoom().
std::string twoMoreEyes() {
    std::string text;
    for (const char* where : {"A", "B"})
        text += std::string("def Xform \"") + where +
                "\"\n{\n    def Camera \"Low\"\n    {\n        float focalLength = 15\n"
                "        double3 xformOp:translate = (1, 0.05, " +
                (where[0] == 'A' ? "0.4" : "0.7") +
                ")\n        double xformOp:rotateX = 85\n        uniform token[] xformOpOrder = "
                "[\"xformOp:translate\", \"xformOp:rotateX\"]\n    }\n}\n";
    return text;
}

TEST_F(Render, WritesAnExrAndAPngAndNothingElse) {
    const Outcome outcome = render("a.exr", {"--png", here.path("a.png")});
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_THAT(outcome.out, IsEmpty());
    EXPECT_THAT(outcome.err, ContainsRegex("wrote .*a.exr: 64 x 36 pixels in cd/m\\^2\n"
                                           "wrote .*a.png: 64 x 36 pixels, exposure .* EV, tone "
                                           "AgX\n"));
    EXPECT_THAT(here.files(), ElementsAre("a.exr", "a.png", "room.usda"));
    EXPECT_EQ(readFile(here.path("a.exr")).substr(0, 4), "\x76\x2f\x31\x01"); // OpenEXR's magic
    EXPECT_EQ(readFile(here.path("a.png")).substr(1, 3), "PNG");
}

/// A lit room's box without the light: nothing in the file says what it is seen by.
std::string darkScene() {
    return "#usda 1.0\n(\n    metersPerUnit = 1\n    upAxis = \"Z\"\n)\ndef Cube \"Box\"\n{\n"
           "    double size = 1\n}\n";
}

TEST_F(Render, ShowsASceneWithoutLightsByAHeadlightAndSaysSo) {
    room = here.write("dark.usda", darkScene());
    for (const char* quality : {"drawn", "final"}) {
        const Outcome outcome = render("a.exr", {"--quality", quality});
        EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
        EXPECT_THAT(outcome.err, HasSubstr("nothing in it gives light that is understood: shown by "
                                           "a headlight"));
        // neutral: 0.5 / pi * 100 lux at most, half of that where it is seen edge-on
        EXPECT_THAT(statistics("a.exr", " --ch R"), ContainsRegex("Stats Max: 1[0-5]\\."))
            << quality;
    }
}

TEST_F(Render, RefusesASceneWithoutLightsIfAsked) {
    room = here.write("dark.usda", darkScene());
    const Outcome outcome = render("a.exr", {"--fallback-light", "none"});
    EXPECT_EQ(outcome.exitCode, 1);
    EXPECT_THAT(outcome.err, HasSubstr("dark.usda: error: nothing in it gives light"));
    EXPECT_THAT(here.files(), ElementsAre("dark.usda", "room.usda"));
}

TEST_F(Render, LeavesASceneDarkWhoseLightsAreSwitchedOff) {
    room = here.write("off.usda", darkScene() + "def SphereLight \"Off\"\n{\n    float "
                                                "inputs:intensity = 0\n}\n");
    const Outcome outcome = render("a.exr");
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_THAT(outcome.err, testing::Not(HasSubstr("headlight")));
    EXPECT_THAT(statistics("a.exr", " --ch R"), HasSubstr("Stats Max: 0.000000"));
}

TEST_F(Render, TellsWhoNamesAnotherFormatThanItWrites) {
    const Outcome output = render("a.PNG");
    EXPECT_EQ(output.exitCode, 2);
    EXPECT_THAT(output.err, testing::HasSubstr("name it .exr"));
    const Outcome png = render("a.exr", {"--png", here.path("b.jpg")});
    EXPECT_EQ(png.exitCode, 2);
    EXPECT_THAT(png.err, testing::HasSubstr("name it .png"));
    EXPECT_THAT(here.files(), ElementsAre("room.usda"));
}

TEST_F(Render, DrawsALitPictureThatAnotherLibraryReads) {
    if (outputOf("command -v oiiotool").empty())
        GTEST_SKIP() << "no oiiotool in PATH (Debian: openimageio-tools)";
    ASSERT_EQ(render("a.exr").exitCode, 0);
    const std::string info = outputOf("oiiotool --info -v " + here.path("a.exr"));
    EXPECT_THAT(info, ContainsRegex("64 x +36"));
    for (const char* channel :
         {"R", "direct.R", "indirect.R", "illuminance.R", "albedo.R", "N.X", "Z", "objectId"})
        EXPECT_THAT(info, HasSubstr(channel));
    EXPECT_THAT(info, HasSubstr("scene: \"room.usda\""));
    EXPECT_THAT(info, HasSubstr("certificate: "));
    // The camera is inside of a closed room: every pixel is covered and none is black.
    const std::string stats =
        outputOf("oiiotool " + here.path("a.exr") + " --ch R,G,B --printstats");
    EXPECT_THAT(stats, testing::Not(HasSubstr("Stats Min: 0.000000")));
}

TEST_F(Render, GivesTheSameFileOnOneThreadAndOnTwo) {
    for (const char* quality : {"drawn", "final"}) {
        ASSERT_EQ(render("one.exr", {"--threads", "1", "--quality", quality}).exitCode, 0);
        ASSERT_EQ(render("two.exr", {"--threads", "2", "--quality", quality}).exitCode, 0);
        EXPECT_EQ(readFile(here.path("one.exr")), readFile(here.path("two.exr"))) << quality;
    }
}

TEST_F(Render, FramesASceneWithoutACameraAndSaysSo) {
    room =
        here.write("bare.usda",
                   meshUnderLight("int[] faceVertexCounts = [4]\nint[] faceVertexIndices = [0, 1, "
                                  "2, 3]\npoint3f[] points = [(-1, -1, 0), (1, -1, 0), (1, 1, 0), "
                                  "(-1, 1, 0)]"));
    const Outcome outcome = render("a.exr");
    EXPECT_EQ(outcome.exitCode, 0);
    EXPECT_THAT(outcome.err, HasSubstr("no camera in the file"));
    EXPECT_EQ(lineCount(outcome.err), 2u); // and what was written
}

TEST_F(Render, TakesTheCameraThatIsNamedOrSaysWhichThereAre) {
    EXPECT_EQ(render("a.exr", {"--camera", "/Eye"}).exitCode, 0);
    const Outcome outcome = render("b.exr", {"--camera", "/Nose"});
    EXPECT_EQ(outcome.exitCode, 1);
    EXPECT_THAT(outcome.err, HasSubstr("no camera '/Nose' (it has /Eye"));
    EXPECT_THAT(here.files(), ElementsAre("a.exr", "room.usda"));
}

TEST_F(Render, OfASceneWithoutLightIsBlackAndSaysSo) {
    std::string dark = smallRoom();
    dark.replace(dark.find("intensity = 100"), 15, "intensity = 0");
    room = here.write("room.usda", dark);
    const Outcome outcome = render("a.exr");
    EXPECT_EQ(outcome.exitCode, 0);
    EXPECT_THAT(outcome.err, HasSubstr("no light"));
    EXPECT_EQ(lineCount(outcome.err), 2u); // and what was written
}

TEST_F(Render, OfASceneWithoutLightThePngIsBlack) {
    std::string dark = smallRoom();
    dark.replace(dark.find("intensity = 100"), 15, "intensity = 0");
    room = here.write("room.usda", dark);
    for (const char* quality : {"drawn", "final"}) {
        ASSERT_EQ(png("a.png", {"--quality", quality}).exitCode, 0);
        if (outputOf("command -v oiiotool").empty()) continue;
        EXPECT_THAT(statistics("a.png"), HasSubstr("Stats Max: 0 0 0")) << quality;
    }
}

TEST_F(Render, WritesAPngAlone) {
    const Outcome outcome = png("a.png");
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_THAT(here.files(), ElementsAre("a.png", "room.usda"));
    EXPECT_EQ(lineCount(outcome.err), 1u);
    EXPECT_THAT(png("b.png", {"--quiet"}).err, IsEmpty());
    EXPECT_EQ(readFile(here.path("a.png")), readFile(here.path("b.png")));
}

TEST_F(Render, WithNothingToWriteIsRefused) {
    const Outcome outcome = runPenumbra({"render", room});
    EXPECT_EQ(outcome.exitCode, 2);
    EXPECT_THAT(outcome.err, HasSubstr("nothing to write"));
}

/// Means of red, green and blue [of 255].
std::array<double, 3> means(const std::string& statistics) {
    std::array<double, 3> values{};
    const std::size_t at = statistics.find("Stats Avg: ");
    if (at == std::string::npos) ADD_FAILURE() << statistics;
    std::istringstream(statistics.substr(at + 11)) >> values[0] >> values[1] >> values[2];
    return values;
}

TEST_F(Render, DrawnAndFinalShowTheSamePicture) {
    if (outputOf("command -v oiiotool").empty())
        GTEST_SKIP() << "no oiiotool in PATH (Debian: openimageio-tools)";
    const Outcome drawn = png("d.png"), final = png("f.png", {"--quality", "final"});
    const auto exposureOf = [](const Outcome& outcome) {
        const std::size_t at = outcome.err.find("exposure ");
        return at == std::string::npos ? "none" : outcome.err.substr(at);
    };
    EXPECT_EQ(exposureOf(drawn), exposureOf(final)) << "the same exposure and tone";
    // All of it, and a part of the wall above the box.
    for (const char* part : {"", " --crop 20x6+22+8 "}) {
        const auto a = means(statistics("d.png", part)), b = means(statistics("f.png", part));
        for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], 3) << part;
    }
}

TEST_F(Render, ExposureAndToneCanBeGiven) {
    ASSERT_EQ(png("mid.png", {"--exposure", "6"}).exitCode, 0);
    ASSERT_EQ(png("dark.png", {"--exposure", "7"}).exitCode, 0);
    const Outcome toned = png("toned.png", {"--exposure", "6", "--tone", "SRGB"});
    ASSERT_EQ(toned.exitCode, 0) << toned.err;
    EXPECT_THAT(toned.err, HasSubstr("exposure 6.00 EV, tone sRGB"));
    EXPECT_NE(readFile(here.path("mid.png")), readFile(here.path("toned.png")));
    if (outputOf("command -v oiiotool").empty()) return;
    EXPECT_GT(means(statistics("mid.png"))[1], means(statistics("dark.png"))[1] + 10);
}

TEST_F(Render, BadExposuresAndTonesAreRefusedInALine) {
    for (const char* value : {"bright", "nan", "inf", "26", "-11", "", "1e999", "6 EV", "AUTO"}) {
        const Outcome outcome = png("a.png", {"--exposure", value});
        EXPECT_EQ(outcome.exitCode, 2) << value;
        EXPECT_THAT(outcome.err, HasSubstr("--exposure")) << value;
    }
    const Outcome outcome = png("a.png", {"--tone", "reinhard"});
    EXPECT_EQ(outcome.exitCode, 2);
    EXPECT_THAT(outcome.err, HasSubstr("'reinhard' is none of agx, aces, srgb"));
    EXPECT_THAT(here.files(), ElementsAre("room.usda"));
}

TEST_F(Render, PicturesSeveralCamerasOfOneSolution) {
    room = here.write("room.usda", smallRoom() + twoMoreEyes());
    const Outcome outcome =
        png("{camera}.png", {"-o", here.path("x-{camera}.exr"), "--camera", "/Eye", "--camera",
                             "/A/Low", "--camera", "/B/Low"});
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_THAT(here.files(), ElementsAre("A-Low.png", "B-Low.png", "Eye.png", "room.usda",
                                          "x-A-Low.exr", "x-B-Low.exr", "x-Eye.exr"));
    EXPECT_EQ(lineCount(outcome.err), 6u);
    ASSERT_EQ(png("alone.png", {"--camera", "/B/Low"}).exitCode, 0);
    EXPECT_EQ(readFile(here.path("alone.png")), readFile(here.path("B-Low.png")));
    EXPECT_NE(readFile(here.path("A-Low.png")), readFile(here.path("B-Low.png")));
}

TEST_F(Render, OfSeveralCamerasNoneOverwritesAnother) {
    const auto refused = [&](const std::string& name, const std::string& why,
                             std::vector<std::string> cameras) {
        std::vector<std::string> more;
        for (std::string& camera : cameras) {
            more.push_back("--camera");
            more.push_back(std::move(camera));
        }
        const Outcome outcome = png(name, more);
        EXPECT_NE(outcome.exitCode, 0);
        EXPECT_THAT(outcome.err, HasSubstr(why));
        EXPECT_THAT(here.files(), ElementsAre("room.usda"));
    };
    refused("a.png", "put {camera} in the name", {"/Eye", "/Nose"});
    refused("{camera}.png", "would overwrite another result", {"/Eye", "/Eye"});
    refused("{camera}.png", "no camera '/Nose'", {"/Eye", "/Nose"}); // before any is written
    refused("{camera}.png", "for those that --camera names", {});
}

} // namespace

} // namespace penumbra
