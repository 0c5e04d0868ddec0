// penumbra render: a scene becomes a picture that others can read.
#include "Program.h"
#include "tests/support/Command.h"

#include <gmock/gmock.h>

namespace penumbra {

namespace {

using testing::ContainsRegex;
using testing::HasSubstr;
using testing::IsEmpty;

class Render : public testing::Test {
protected:
    Workplace here;
    std::string room = here.write("room.usda", smallRoom());

    Outcome render(const std::string& output, std::vector<std::string> more = {}) {
        std::vector<std::string> arguments{"render",  room, "-o",       here.path(output),
                                           "--width", "64", "--height", "36"};
        for (const std::string& word : coarse()) arguments.push_back(word);
        arguments.insert(arguments.end(), more.begin(), more.end());
        return runPenumbra(arguments);
    }
};

TEST_F(Render, WritesAnExrAndAPngAndNothingElse) {
    const Outcome outcome = render("a.exr", {"--png", here.path("a.png")});
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_THAT(outcome.out, IsEmpty());
    EXPECT_THAT(here.files(), testing::ElementsAre("a.exr", "a.png", "room.usda"));
    EXPECT_EQ(readFile(here.path("a.exr")).substr(0, 4), "\x76\x2f\x31\x01"); // OpenEXR's magic
    EXPECT_EQ(readFile(here.path("a.png")).substr(1, 3), "PNG");
}

TEST_F(Render, TellsWhoNamesAnotherFormatThanItWrites) {
    const Outcome output = render("a.PNG");
    EXPECT_EQ(output.exitCode, 2);
    EXPECT_THAT(output.err, testing::HasSubstr("name it .exr"));
    const Outcome png = render("a.exr", {"--png", here.path("b.jpg")});
    EXPECT_EQ(png.exitCode, 2);
    EXPECT_THAT(png.err, testing::HasSubstr("name it .png"));
    EXPECT_THAT(here.files(), testing::ElementsAre("room.usda"));
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
    // The camera stands inside of a closed room: every pixel is covered and none is black.
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
    EXPECT_EQ(lineCount(outcome.err), 1u);
}

TEST_F(Render, TakesTheCameraThatIsNamedOrSaysWhichThereAre) {
    EXPECT_EQ(render("a.exr", {"--camera", "/Eye"}).exitCode, 0);
    const Outcome outcome = render("b.exr", {"--camera", "/Nose"});
    EXPECT_EQ(outcome.exitCode, 1);
    EXPECT_THAT(outcome.err, HasSubstr("no camera '/Nose' (it has /Eye"));
    EXPECT_THAT(here.files(), testing::ElementsAre("a.exr", "room.usda"));
}

TEST_F(Render, OfASceneWithoutLightIsBlackAndSaysSo) {
    std::string dark = smallRoom();
    dark.replace(dark.find("intensity = 100"), 15, "intensity = 0");
    room = here.write("room.usda", dark);
    const Outcome outcome = render("a.exr");
    EXPECT_EQ(outcome.exitCode, 0);
    EXPECT_THAT(outcome.err, HasSubstr("no light"));
    EXPECT_EQ(lineCount(outcome.err), 1u);
}

} // namespace

} // namespace penumbra
