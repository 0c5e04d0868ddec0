// penumbra solve: sensors, statistics.
#include "Program.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <sstream>

#include <unistd.h>

namespace penumbra {

namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const std::string kSensors = "x,y,z,nx,ny,nz\n0.4,0.4,0,0,0,1\n1.6,0.3,0,0,0,1\n0,1,1,1,0,0\n";

std::vector<std::string> solve(const std::string& scene, std::vector<std::string> more) {
    std::vector<std::string> arguments{"solve", scene};
    const bool sized = std::find(more.begin(), more.end(), "--element-size") != more.end();
    if (!sized)
        for (const std::string& word : coarse()) arguments.push_back(word);
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

/// Numbers of a CSV file below its header.
std::vector<std::vector<double>> numbers(const std::string& csv) {
    std::vector<std::vector<double>> rows;
    std::istringstream text(csv);
    std::string line, cell;
    std::getline(text, line);
    while (std::getline(text, line)) {
        rows.emplace_back();
        std::istringstream cells(line);
        while (std::getline(cells, cell, ',')) rows.back().push_back(std::stod(cell));
    }
    return rows;
}

class Solve : public testing::Test {
protected:
    Workplace here;
    std::string room = here.write("room.usda", smallRoom());
    std::string sensors = here.write("in.csv", kSensors);

    std::vector<std::vector<double>> values(std::vector<std::string> more = {}) {
        std::vector<std::string> arguments{"--sensors", sensors, "--values", here.path("out.csv")};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Outcome outcome = runPenumbra(solve(room, arguments));
        EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
        EXPECT_THAT(outcome.out, IsEmpty());
        return numbers(readFile(here.path("out.csv")));
    }
};

TEST_F(Solve, RepeatsTheSensorsAndAddsTheirIlluminance) {
    const auto rows = values();
    EXPECT_EQ(readFile(here.path("out.csv")).substr(0, 21), "x,y,z,nx,ny,nz,r,g,b\n");
    ASSERT_EQ(rows.size(), 3u);
    const auto in = numbers(kSensors);
    for (std::size_t i = 0; i < 3; ++i) {
        ASSERT_EQ(rows[i].size(), 9u);
        for (std::size_t k = 0; k < 6; ++k) EXPECT_FLOAT_EQ(float(rows[i][k]), float(in[i][k]));
        for (std::size_t k = 6; k < 9; ++k) EXPECT_GT(rows[i][k], 1); // a light of 100 nits
    }
}

TEST_F(Solve, SensorsMayComeFromAPipe) {
    std::array<int, 2> ends;
    ASSERT_EQ(pipe(ends.data()), 0);
    ASSERT_EQ(write(ends[1], kSensors.data(), kSensors.size()), ssize_t(kSensors.size()));
    close(ends[1]);
    const std::string reading = "/dev/fd/" + std::to_string(ends[0]);
    const Outcome outcome =
        runPenumbra(solve(room, {"--sensors", reading, "--values", here.path("piped.csv")}));
    close(ends[0]);
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_EQ(numbers(readFile(here.path("piped.csv"))), values());
}

TEST_F(Solve, GatheredAgreesWithDrawn) {
    const auto drawn = values({"--element-size", "0.05"}), gathered = values({"--gather"});
    ASSERT_EQ(drawn.size(), 3u);
    ASSERT_EQ(gathered.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(gathered[i][7], drawn[i][7], 0.1 * drawn[i][7]);
}

TEST_F(Solve, DirectLightAloneIsLessThanAllLight) {
    const auto all = values(), direct = values({"--direct-only"});
    ASSERT_EQ(all.size(), 3u);
    ASSERT_EQ(direct.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_LT(direct[i][6], all[i][6]);
        EXPECT_GT(direct[i][6], 0);
    }
}

TEST_F(Solve, GivesTheSameBytesOnOneThreadAndOnTwo) {
    for (const char* how : {"--verbose", "--gather"}) {
        values({"--threads", "1", how});
        const std::string one = readFile(here.path("out.csv"));
        values({"--threads", "2", how});
        EXPECT_EQ(readFile(here.path("out.csv")), one);
    }
}

TEST_F(Solve, WritesValuesToStandardOutputForADash) {
    const Outcome outcome = runPenumbra(solve(room, {"--sensors", sensors, "--values", "-"}));
    EXPECT_EQ(outcome.exitCode, 0);
    EXPECT_EQ(numbers(outcome.out).size(), 3u);
    EXPECT_THAT(outcome.err, IsEmpty());
}

TEST_F(Solve, IsQuietWhenAsked) {
    const Outcome outcome = runPenumbra(solve(room, {"--quiet"}));
    EXPECT_EQ(outcome.exitCode, 0);
    EXPECT_THAT(outcome.out + outcome.err, IsEmpty());
}

TEST_F(Solve, ShowsNoProgressWhenStandardErrorIsNoTerminal) {
    EXPECT_THAT(runPenumbra(solve(room, {})).err, Not(HasSubstr("\r")));
    EXPECT_THAT(runPenumbra(solve(room, {"--progress"})).err, HasSubstr("%"));
}

TEST_F(Solve, WritesStatisticsWithTheKeysOfTheContract) {
    const std::string file = here.path("stats.json");
    ASSERT_EQ(runPenumbra(solve(room, {"--stats", file})).exitCode, 0);
    const auto json = nlohmann::json::parse(readFile(file));
    for (const char* key : {"objects", "polygons", "patches", "elements", "vertices", "emitters"})
        EXPECT_GT(json.at("scene").at(key), 0) << key;
    for (const char* key : {"shots", "residual", "certificate", "seconds", "rays"})
        EXPECT_GT(json.at("solve").at(key), 0) << key;
    for (const char* key : {"rows", "entries", "bytes"})
        EXPECT_GT(json.at("sffl").at(key), 0) << key;
    EXPECT_GT(json.at("memory").at("peak_bytes"), 1000000);
    ASSERT_TRUE(json.at("phases").is_object());
    for (const auto& [name, seconds] : json.at("phases").items()) EXPECT_GE(seconds, 0) << name;
    EXPECT_EQ(json.at("scene").at("emitters"), 1);
    EXPECT_EQ(json.at("solve").at("state"), "exact");
}

TEST_F(Solve, SaysOnceThatRowsDoNotFitIntoTheMemoryThatIsAllowed) {
    const std::string stats = here.path("stats.json"), kept = here.path("kept.json");
    const Outcome outcome = runPenumbra(solve(room, {"--memory", "0.01", "--stats", stats}));
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    const std::size_t at = outcome.err.find("no rows of patches are kept: of 0.01 GB of memory");
    ASSERT_NE(at, std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.err.find("rows of patches", at + 20), std::string::npos) << outcome.err;
    const auto json = nlohmann::json::parse(readFile(stats));
    EXPECT_EQ(json.at("memory").at("budget_bytes"), 10000000);
    EXPECT_GT(json.at("sffl").at("rows_not_kept"), 0);

    EXPECT_THAT(runPenumbra(solve(room, {"--stats", kept})).err, Not(HasSubstr("kept")));
    const auto all = nlohmann::json::parse(readFile(kept));
    EXPECT_EQ(all.at("sffl").at("rows_not_kept"), 0);
    EXPECT_EQ(all.at("solve").at("shots"), json.at("solve").at("shots"));
    EXPECT_EQ(all.at("solve").at("certificate"), json.at("solve").at("certificate"));
}

TEST_F(Solve, MemoryIsAPositiveNumber) {
    for (const char* memory : {"0", "-1", "nan", "inf", "many"})
        for (const char* command : {"solve", "view", "radiosity"}) {
            const Outcome outcome = runPenumbra({command, room, "--memory", memory});
            EXPECT_EQ(outcome.exitCode, 2) << command << memory;
            EXPECT_THAT(outcome.err, HasSubstr("--memory: ")) << command << memory;
        }
}

/// smallRoom() with something instead of its light's intensity, and something added.
std::string roomWith(const std::string& intensity, const std::string& more) {
    std::string text = smallRoom();
    const std::string old = "inputs:intensity = 100";
    text.replace(text.find(old), old.size(), "inputs:intensity = " + intensity);
    return text + more;
}

/// A black plate 2 cm below the light.
const std::string kShade = R"(def Cube "Shade"
{
    double size = 1
    color3f[] primvars:displayColor = [(0.01, 0.01, 0.01)]
    double3 xformOp:translate = (1, 1, 1.965)
    float3 xformOp:scale = (1.2, 1, 0.01)
    uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:scale"]
}
)";

TEST_F(Solve, WarnsWhereTheCertificateIsAsLargeAsTheLight) {
    const std::string stats = here.path("stats.json");
    const std::vector<std::string> rough{"--residual", "0.005", "--stats", stats};
    const auto share = [&] {
        return nlohmann::json::parse(readFile(stats)).at("solve").at("certificate_of_lit");
    };
    Outcome outcome = runPenumbra(solve(here.write("open.usda", smallRoom()), rough));
    EXPECT_THAT(outcome.err, Not(HasSubstr("warning")));
    EXPECT_THAT(outcome.err, HasSubstr("% of the light on lit surfaces"));
    EXPECT_LT(share(), 1);
    outcome = runPenumbra(solve(here.write("shaded.usda", roomWith("100", kShade)), rough));
    EXPECT_EQ(outcome.exitCode, 0);
    EXPECT_THAT(outcome.err, HasSubstr("shaded.usda: warning: the certificate"));
    EXPECT_THAT(outcome.err, HasSubstr("says nothing: it is as large as the light itself"));
    EXPECT_GE(share(), 1);
}

TEST_F(Solve, SaysThatNothingIsLit) {
    const std::string stats = here.path("stats.json");
    const Outcome outcome =
        runPenumbra(solve(here.write("black.usda", roomWith("0", "")), {"--stats", stats}));
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("nothing is lit"));
    EXPECT_THAT(outcome.err, Not(HasSubstr("says nothing")));
    const auto json = nlohmann::json::parse(readFile(stats)).at("solve");
    EXPECT_EQ(json.at("lit_illuminance"), 0);
    EXPECT_TRUE(json.at("certificate_of_lit").is_null());
}

TEST_F(Solve, SaysWhereASensorListIsWrong) {
    const std::vector<std::pair<std::string, std::string>> wrong{
        {"x,y,z,nx,ny\n", "bad.csv:1: error: no column 'nz'"},
        {"x,y,z,nx,ny,nz\n0,0,0,0,0,1\n0,0,zero,0,0,1\n",
         "bad.csv:3: error: 'zero' is not a number"},
        {"x,y,z,nx,ny,nz\n0,0,0,0,0\n", "bad.csv:2: error: too few values"},
        {"x,y,z,nx,ny,nz\n0,0,inf,0,0,1\n", "bad.csv:2: error: 'inf' is not a number"},
        {"x,y,z,nx,ny,nz\n0,0,0,0,0,0\n", "bad.csv:2: error: the normal is zero"},
        {"", "bad.csv:1: error: no column"},
    };
    for (const auto& [text, message] : wrong) {
        const Outcome outcome = runPenumbra(solve(
            room, {"--sensors", here.write("bad.csv", text), "--values", here.path("v.csv")}));
        EXPECT_EQ(outcome.exitCode, 1) << text;
        EXPECT_THAT(outcome.err, HasSubstr(message));
        EXPECT_EQ(lineCount(outcome.err), 1u);
    }
    const Outcome missing =
        runPenumbra(solve(room, {"--sensors", here.path("none.csv"), "--values", "-"}));
    EXPECT_EQ(missing.exitCode, 1);
    EXPECT_THAT(missing.err, HasSubstr("none.csv: error: "));
}

} // namespace

TEST_F(Solve, PatchesAreAsLargeAsTheFileAsksUnlessTheCommandLineDoes) {
    // The chamber is to have the 1,250 patches of Schoeffel's simple scene (1998), within 5 %.
    const std::string chamber = PENUMBRA_SOURCE_DIR "/scenes/chamber.usda";
    const auto patches = [&](std::vector<std::string> more) {
        more.insert(more.begin(),
                    {"solve", chamber, "--direct-only", "--stats", here.path("s.json")});
        EXPECT_EQ(runPenumbra(more).exitCode, 0);
        return nlohmann::json::parse(readFile(here.path("s.json")))["scene"]["patches"].get<int>();
    };
    EXPECT_NEAR(patches({}), 1250, 62);
    EXPECT_LT(patches({"--patch-size", "0.5"}), 800);
}

} // namespace penumbra
