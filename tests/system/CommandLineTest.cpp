// The command line: help, exit codes, where words go.
#include "Program.h"

#include <gmock/gmock.h>

namespace penumbra {

namespace {

using testing::HasSubstr;
using testing::IsEmpty;

TEST(CommandLine, HelpSaysTheCommandsAndTheExitCodes) {
    const Outcome help = runPenumbra({"--help"});
    EXPECT_EQ(help.exitCode, 0);
    for (const char* word : {"render", "solve", "info", "Exit codes"})
        EXPECT_THAT(help.out, HasSubstr(word));
    EXPECT_THAT(help.err, IsEmpty());
}

TEST(CommandLine, HelpOfACommandSaysItsOptions) {
    const Outcome render = runPenumbra({"render", "--help"});
    EXPECT_EQ(render.exitCode, 0);
    for (const char* word :
         {"--output", "--patch-size", "--element-size", "--samples", "--residual", "--direct-only",
          "--threads", "--frame", "--order", "--camera", "--stats", "--quality", "--png"})
        EXPECT_THAT(render.out, HasSubstr(word));
    const Outcome solve = runPenumbra({"solve", "--help"});
    EXPECT_EQ(solve.exitCode, 0);
    for (const char* word : {"--sensors", "--values", "--gather", "--stats"})
        EXPECT_THAT(solve.out, HasSubstr(word));
}

TEST(CommandLine, VersionIsOneLine) {
    const Outcome version = runPenumbra({"--version"});
    EXPECT_EQ(version.exitCode, 0);
    EXPECT_THAT(version.out, testing::MatchesRegex("penumbra [0-9]+\\.[0-9]+\\.[0-9]+\n"));
}

TEST(CommandLine, ThatIsWrongExitsWithTwoAndPrintsNothingToStandardOutput) {
    const Workplace here;
    const std::string room = here.write("room.usda", smallRoom());
    const std::vector<std::vector<std::string>> wrong{
        {},
        {"paint"},
        {"solve"},
        {"render", room}, // no -o
        {"solve", room, "--patch-size", "-1"},
        {"solve", room, "--patch-size", "wide"},
        {"solve", room, "--samples", "0"},
        {"solve", room, "--residual", "2"},
        {"solve", room, "--residual", "nan"},
        {"solve", room, "--patch-size", "nan"},
        {"solve", room, "--threads", "0"},
        {"solve", room, "--order", "oracle"},
        {"solve", room, "--sensors", "a.csv"}, // no --values
        {"solve", room, "--gather"},           // no --sensors
        {"solve", room, "--no-such-option"},
        {"render", room, "-o", here.path("a.exr"), "--quality", "best"},
        {"render", room, "-o", here.path("a.exr"), "--width", "0"},
    };
    for (const auto& arguments : wrong) {
        const Outcome outcome = runPenumbra(arguments);
        const std::string line = testing::PrintToString(arguments);
        EXPECT_EQ(outcome.exitCode, 2) << line;
        EXPECT_THAT(outcome.out, IsEmpty()) << line;
        EXPECT_THAT(outcome.err, testing::Not(IsEmpty())) << line;
    }
    EXPECT_THAT(here.files(), testing::ElementsAre("room.usda"));
}

TEST(CommandLine, NamesTheWordThatItDoesNotKnow) {
    const std::vector<std::pair<std::vector<std::string>, std::string>> lines{
        {{"rendr", "x"}, "penumbra: error: unknown command 'rendr'; did you mean 'render'? ("},
        {{"--quiet", "slove", "x"}, "unknown command 'slove'; did you mean 'solve'? ("},
        {{"paint"}, "unknown command 'paint' (there are: view, render, solve, info, "},
        {{"--bogus"}, "penumbra: error: unknown option '--bogus' ("},
        {{"solve", "a", "--elemnt-size", "3"},
         "penumbra solve: error: unknown option '--elemnt-size'; did you mean '--element-size'? ("},
        {{"render", "a", "-o", "b", "--widht=3"}, "option '--widht'; did you mean '--width'? ("},
        {{"info", "a", "b"}, "penumbra info: error: 'b' is one word too many ("}};
    for (const auto& [arguments, text] : lines) {
        const Outcome outcome = runPenumbra(arguments);
        EXPECT_EQ(outcome.exitCode, 2) << outcome.err;
        EXPECT_THAT(outcome.err, HasSubstr(text));
        EXPECT_EQ(lineCount(outcome.err), 1u) << outcome.err;
        EXPECT_THAT(outcome.out, IsEmpty());
    }
}

TEST(CommandLine, InfoSaysWhatIsInAScene) {
    const Workplace here;
    const Outcome info = runPenumbra({"info", here.write("room.usda", smallRoom())});
    EXPECT_EQ(info.exitCode, 0);
    for (const char* word : {"up axis Z", "2 meshes", "1 lights", "  /Lamp ", "1 cameras",
                             "  /Eye\n", "no animation", "  3 objects, "})
        EXPECT_THAT(info.out, HasSubstr(word));
    EXPECT_THAT(info.err, IsEmpty());
}

TEST(CommandLine, InfoSaysTheFramesAndTheObjectsAndPathsAsTheFileHasThem) {
    const Workplace here;
    const Outcome info = runPenumbra({"info", here.write("played.usda", R"(#usda 1.0
(
    metersPerUnit = 1
    startTimeCode = 3
    endTimeCode = 48
    timeCodesPerSecond = 12
)
def Xform "World"
{
    def SphereLight "Bulb"
    {
        double3 xformOp:translate.timeSamples = { 3: (0, 0, 2), 48: (1, 0, 2) }
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }
    def Cube "Guest"
    {
        token visibility.timeSamples = { 3: "invisible", 20: "inherited" }
    }
    def Cube "Wall"
    {
        double3 xformOp:translate = (0, 5, 0)
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }
    def Camera "C"
    {
        double3 xformOp:translate = (0, -5, 0)
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }
}
)")});
    EXPECT_EQ(info.exitCode, 0) << info.err;
    for (const char* word : {"animation from frame 3 to 48, 12 a second\n",
                             "  /World/Bulb\n  /World/Guest (hidden)\n  /World/Wall\n",
                             "  /World/Bulb  ", "  1 cameras\n  /World/C\n"})
        EXPECT_THAT(info.out, HasSubstr(word));
    for (const char* twice : {"Bulb/Bulb", "Guest/Guest", "C/C"})
        EXPECT_THAT(info.out, testing::Not(HasSubstr(twice)));
}

} // namespace

} // namespace penumbra
