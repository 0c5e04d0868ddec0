// penumbra info --at: why it is as bright or dark as it is at a point; --composition.
#include "Program.h"

#include <gmock/gmock.h>

#include <sstream>

namespace penumbra {

namespace {

using testing::HasSubstr;
using testing::IsEmpty;

class InfoAt : public testing::Test {
protected:
    Workplace here;
    std::string room = here.write("room.usda", smallRoom());

    Outcome at(const std::string& point, std::vector<std::string> more = coarse()) {
        std::vector<std::string> arguments{"info", room, "--at", point};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return runPenumbra(arguments);
    }
};

/// The first numbers of the line that begins with these words.
std::vector<double> figures(const std::string& text, const std::string& words) {
    std::istringstream lines(text);
    std::vector<double> numbers;
    for (std::string line; std::getline(lines, line);) {
        const std::size_t start = line.find(words);
        if (start == std::string::npos) continue;
        std::istringstream rest(line.substr(start + words.size()));
        for (double number; rest >> number;) numbers.push_back(number);
        break;
    }
    return numbers;
}

TEST_F(InfoAt, NamesTheSurfaceTheLightsAndWhatArrives) {
    const Outcome info = at("0.4,0.4,0");
    EXPECT_EQ(info.exitCode, 0) << info.err;
    for (const char* word :
         {"on /Room, 0 mm away", "0 mm away", "facing (0, 0, 1)", "/Lamp", "indirect light"})
        EXPECT_THAT(info.out, HasSubstr(word));
    const auto light = figures(info.out, "/Lamp");
    ASSERT_EQ(light.size(), 4u) << info.out; // unoccluded, arrives, lost, percent
    EXPECT_GT(light[0], 1);
    EXPECT_EQ(light[1], light[0]);
    EXPECT_EQ(light[2], 0);
    const auto direct = figures(info.out, "direct light, all lights"),
               indirect = figures(info.out, "indirect light"),
               together = figures(info.out, "together");
    ASSERT_TRUE(direct.size() == 4 && indirect.size() == 1 && together.size() == 1) << info.out;
    EXPECT_GT(indirect[0], 0.1 * direct[1]);
    EXPECT_NEAR(together[0], direct[1] + indirect[0], 2e-3 * together[0]);
}

TEST_F(InfoAt, SaysWhoIsInTheWayAndWhatThatCosts) {
    // A low board over the floor, in the umbra of which nothing arrives.
    room = here.write("board.usda", smallRoom() + R"(
def Cube "Board"
{
    double size = 1
    double3 xformOp:translate = (0.6, 0.6, 0.2)
    float3 xformOp:scale = (0.6, 0.6, 0.02)
    uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:scale"]
}
)");
    const Outcome info = at("0.6,0.6,0", {"--element-size", "0.05", "--direct-only"});
    EXPECT_EQ(info.exitCode, 0) << info.err;
    const auto light = figures(info.out, "/Lamp"), board = figures(info.out, "to /Board");
    ASSERT_TRUE(light.size() == 4 && board.size() == 2) << info.out;
    EXPECT_EQ(light[1], 0);
    EXPECT_EQ(light[2], light[0]);
    EXPECT_EQ(board[0], light[0]);
    EXPECT_EQ(board[1], 100);
    EXPECT_THAT(info.out, Not(HasSubstr("indirect")));
}

TEST_F(InfoAt, FindsTheNearestSurfaceAndSaysHowFarItIs) {
    const Outcome info = at("0.02,1.1,1");
    EXPECT_EQ(info.exitCode, 0) << info.err;
    EXPECT_THAT(info.out, HasSubstr("on /Room, 20 mm away at (0, 1.1, 1), facing (1, 0, 0)"));
}

TEST_F(InfoAt, AFarPointIsOneLine) {
    const Outcome info = at("-7,0.4,0");
    EXPECT_EQ(info.exitCode, 1);
    EXPECT_THAT(info.err, HasSubstr("room.usda: error: no surface within 0.25 m of (-7, 0.4, 0)"));
    EXPECT_EQ(lineCount(info.err), 1u) << info.err;
    EXPECT_THAT(info.out, IsEmpty());
}

TEST_F(InfoAt, AWrongPointIsAWrongCommandLine) {
    for (const char* point : {"1,2", "1,2,3,4", "nan,0,0", "0,inf,0", "1e39,0,0", "1,,2", "a,b,c",
                              "1, 2,3", "1,2,3 ", ","}) {
        const Outcome info = at(point);
        EXPECT_EQ(info.exitCode, 2) << point;
        EXPECT_THAT(info.err, HasSubstr("three numbers")) << point;
        EXPECT_THAT(info.out, IsEmpty()) << point;
    }
}

TEST_F(InfoAt, CostSaysWhatLightingTheSceneWillTake) {
    const auto cost = [&](std::vector<std::string> more) {
        std::vector<std::string> arguments{"info", room, "--cost", "--patch-size", "0.25"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return runPenumbra(arguments);
    };
    const Outcome info = cost({"--threads", "1"});
    EXPECT_EQ(info.exitCode, 0) << info.err;
    for (const char* word : {" patches, ", "direct light: about ", "all light: about ",
                             " of processor, 1 thread)", " million rays, ", " MB"})
        EXPECT_THAT(info.out, HasSubstr(word));
    EXPECT_THAT(cost({"--direct-only"}).out, Not(HasSubstr("all light")));
    EXPECT_THAT(cost({"--memory", "0.01"}).out, HasSubstr("0 % of the rows of patches fit"));
    EXPECT_EQ(runPenumbra({"info", room, "--cost", "--at", "0,0,0"}).exitCode, 2);
}

TEST(InfoComposition, SaysWhatEachPrimIsComposedOf) {
    const Workplace here;
    here.write("chair.usda", "#usda 1.0\ndef \"C\"\n{\n    def \"Seat\"\n    {\n    }\n}\n");
    const std::string scene = here.write("scene.usda", R"(#usda 1.0
def "a" (
    references = [@chair.usda@</C>, @none.usda@]
)
{
}
)");
    const Outcome info =
        runPenumbra({"info", scene, "--composition", here.path("out.json"), "--verbose"});
    EXPECT_EQ(info.exitCode, 0) << info.err;
    EXPECT_THAT(info.out, IsEmpty());
    EXPECT_THAT(info.err, HasSubstr("scene.usda:3:37"));
    const std::string json = readFile(here.path("out.json"));
    for (const char* part :
         {R"("Entry": "scene.usda")", R"("/a/Seat")", R"("chair.usda": "/C/Seat")",
          R"("Full Prim Stack")", "Errors while composing </a>"})
        EXPECT_THAT(json, HasSubstr(part));
}

TEST(InfoComposition, OverwritesNoLayer) {
    const Workplace here;
    const std::string chair = here.write("chair.usda", "#usda 1.0\ndef \"C\"\n{\n}\n");
    const std::string scene =
        here.write("scene.usda", "#usda 1.0\ndef \"a\" (references = @chair.usda@</C>)\n{\n}\n");
    const Outcome info = runPenumbra({"info", scene, "--composition", chair});
    EXPECT_EQ(info.exitCode, 2);
    EXPECT_THAT(info.err, HasSubstr("which is read"));
    EXPECT_THAT(readFile(chair), HasSubstr("#usda"));
}

TEST(InfoComposition, ARefusedLayerIsWrittenDownAndAFault) {
    const Workplace here;
    const std::string scene = here.write("scene.usda", "#usda 1.0\ndef a");
    const Outcome info = runPenumbra({"info", scene, "--composition", here.path("out.json")});
    EXPECT_EQ(info.exitCode, 1);
    EXPECT_THAT(readFile(here.path("out.json")), HasSubstr("Errors"));
}

TEST_F(InfoAt, MeshingIsOnlyAskedForWithAPoint) {
    const Outcome info = runPenumbra({"info", room, "--patch-size", "0.5"});
    EXPECT_EQ(info.exitCode, 2);
    EXPECT_THAT(info.err, HasSubstr("requires --at"));
}

} // namespace

} // namespace penumbra
