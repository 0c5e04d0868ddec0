// What bad input gets: one clear line and the right exit code, never a crash, never a long wait.
#include "Program.h"

#include <gmock/gmock.h>

namespace penumbra {

namespace {

using testing::HasSubstr;
using testing::IsEmpty;

class BadInput : public testing::Test {
protected:
    Workplace here;

    Outcome solve(const std::string& scene) {
        std::vector<std::string> arguments{"solve", scene};
        for (const std::string& word : coarse()) arguments.push_back(word);
        return runPenumbra(arguments, {.cpuSeconds = 20});
    }

    /// The program refuses the file, in one line that names it.
    void expectRefused(const std::string& name, const std::string& text,
                       const std::string& message = ": error: ") {
        const Outcome outcome = solve(here.write(name, text));
        EXPECT_EQ(outcome.exitCode, 1) << name;
        EXPECT_THAT(outcome.err, HasSubstr(name)) << name;
        EXPECT_THAT(outcome.err, HasSubstr(message)) << name;
        EXPECT_EQ(lineCount(outcome.err), 1u) << outcome.err;
        EXPECT_THAT(outcome.out, IsEmpty());
    }

    /// The program leaves out the faces or the mesh, says so, and goes on with the rest.
    void expectSkipped(const std::string& name, const std::string& attributes,
                       const std::string& warning) {
        const Outcome outcome = solve(here.write(name, meshUnderLight(attributes)));
        EXPECT_EQ(outcome.exitCode, 0) << name << ": " << outcome.err;
        EXPECT_THAT(outcome.err, testing::ContainsRegex(warning)) << name;
        EXPECT_LE(lineCount(outcome.err), 3u) << outcome.err;
        EXPECT_THAT(outcome.out, IsEmpty());
    }
};

TEST_F(BadInput, AMissingFileIsNamed) {
    const Outcome outcome = solve(here.path("none.usda"));
    EXPECT_EQ(outcome.exitCode, 1);
    EXPECT_THAT(outcome.err, HasSubstr("none.usda: error: "));
    EXPECT_EQ(lineCount(outcome.err), 1u);
}

TEST_F(BadInput, OfAWindowIsNamedBeforeOneIsOpened) {
    const Outcome outcome = runPenumbra({"view", here.path("none.usda")});
    EXPECT_EQ(outcome.exitCode, 1);
    EXPECT_THAT(outcome.err, HasSubstr("none.usda: error: can't read: there is no such file"));
    EXPECT_EQ(lineCount(outcome.err), 1u);
}

TEST_F(BadInput, AFolderInsteadOfAFileIsToldApart) {
    std::filesystem::create_directory(here.path("folder.usda"));
    const Outcome outcome = solve(here.path("folder.usda"));
    EXPECT_EQ(outcome.exitCode, 1);
    EXPECT_THAT(outcome.err, HasSubstr("folder.usda: error: "));
    EXPECT_EQ(lineCount(outcome.err), 1u);
}

TEST_F(BadInput, AFileThatCannotBeReadIsOneLineOfOurOwn) {
    std::filesystem::create_symlink("loop.usda", here.path("loop.usda"));
    std::filesystem::create_directory(here.path("folder"));
    const std::string room = here.write("room.usda", smallRoom());
    const std::vector<std::pair<std::string, std::string>> faults{
        {here.path("none"), "there is no such file ("},
        {here.path("loop.usda"), "its symbolic links lead in a circle ("},
        {here.path(std::string(300, 'n')), "its name is too long ("},
        {room + "/below", "is a file, not a folder ("},
        {here.path("folder"), "it is a folder ("}};
    for (const auto& [file, reason] : faults) {
        for (const auto& arguments :
             {std::vector<std::string>{"info", file},
              {"solve", file},
              {"solve", room, "--sensors", file, "--values", here.path("v.csv")}}) {
            const Outcome outcome = runPenumbra(arguments);
            EXPECT_EQ(outcome.exitCode, 1) << outcome.err;
            EXPECT_THAT(outcome.err, HasSubstr(file + ": error: can't read: "));
            EXPECT_THAT(outcome.err, HasSubstr(reason));
            EXPECT_EQ(lineCount(outcome.err), 1u) << outcome.err;
        }
    }
}

TEST_F(BadInput, ATruncatedFileIsRefusedWithThePlaceWhereItEnds) {
    const std::string room = smallRoom();
    for (std::size_t part : {10u, 40u, 300u, 700u, 1000u})
        expectRefused("cut.usda", room.substr(0, part), "cut.usda:");
}

TEST_F(BadInput, OfTheWrongKindIsRefused) {
    expectRefused("empty.usda", "");
    expectRefused("crate.usda", "PXR-USDC\0\0\0\0\1\2\3");
    expectRefused("picture.usda", "\x89PNG\r\n\x1a\n");
    expectRefused("model.usda", "# Blender\nv 0 0 0\n");
    expectRefused("zeros.usda", std::string(1000, '\0'));
}

TEST_F(BadInput, TenMegabytesOfOpenBracketsAreRefused) {
    expectRefused("brackets.usda", "#usda 1.0\n" + std::string(10'000'000, '('));
    expectRefused("values.usda",
                  "#usda 1.0\ndef Mesh \"M\" { float3[] a = " + std::string(10'000'000, '(') + "}");
    std::string nested = "#usda 1.0\n";
    for (int i = 0; i < 200'000; ++i) nested += "def \"a\" {\n";
    expectRefused("nested.usda", nested);
}

const std::string kSquare = "point3f[] points = [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)]\n";
const std::string kOneFace =
    "int[] faceVertexCounts = [4]\nint[] faceVertexIndices = [0, 1, 2, 3]\n";

TEST_F(BadInput, PointsThatAreNoNumbersAreLeftOut) {
    const auto points = [](const std::string& bad) {
        return "point3f[] points = [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, " + bad +
               "), (0, 2, 0)]\nint[] faceVertexCounts = [4, 3]\n"
               "int[] faceVertexIndices = [0, 1, 2, 3, 0, 1, 2]\n";
    };
    expectSkipped("inf.usda", points("inf"), "warning");
    expectSkipped("nan.usda", points("nan"), "warning");
    expectSkipped("minusinf.usda", points("-inf"), "warning");
}

TEST_F(BadInput, IndicesOutOfRangeAreLeftOut) {
    expectSkipped("high.usda",
                  kSquare + "int[] faceVertexCounts = [4, 3]\n"
                            "int[] faceVertexIndices = [0, 1, 2, 3, 0, 1, 99]\n",
                  "warning");
    expectSkipped("low.usda",
                  kSquare + "int[] faceVertexCounts = [4, 3]\n"
                            "int[] faceVertexIndices = [0, 1, 2, 3, 0, 1, -1]\n",
                  "warning");
}

TEST_F(BadInput, CountsThatMakeNoFaceAreLeftOut) {
    for (const char* counts : {"[-4]", "[4, -3]", "[2147483647]", "[4, 4]", "[0, 1, 2]"})
        expectSkipped(
            "counts.usda",
            kSquare + "int[] faceVertexIndices = [0, 1, 2, 3]\nint[] faceVertexCounts = " + counts +
                "\n",
            "warning");
}

TEST_F(BadInput, FacesWithoutAreaAreLeftOutAndCounted) {
    expectSkipped("flat.usda",
                  kSquare + "int[] faceVertexCounts = [4, 3, 3]\n"
                            "int[] faceVertexIndices = [0, 1, 2, 3, 0, 1, 1, 2, 2, 2]\n",
                  "2 (x|faces)");
}

TEST_F(BadInput, AFaceThatIsNotPlanarIsLitAllTheSame) {
    const Outcome outcome = solve(here.write(
        "saddle.usda", meshUnderLight("point3f[] points = [(-1, -1, 0.5), (1, -1, 0), (1, 1, 0.5), "
                                      "(-1, 1, 0)]\n" +
                                      kOneFace)));
    EXPECT_EQ(outcome.exitCode, 0);
    EXPECT_EQ(lineCount(outcome.err), 1u) << outcome.err; // the summary
}

TEST_F(BadInput, AFaceOfAMillionSidesTakesNoLongTime) {
    std::string points = kSquare.substr(0, kSquare.size() - 2), indices;
    for (int i = 0; i < 1'000'000; ++i) {
        points += ", (" + std::to_string(i % 1000) + ", " + std::to_string(i / 1000) + ", 0)";
        indices += ", " + std::to_string(4 + i);
    }
    expectSkipped("million.usda",
                  points +
                      "]\nint[] faceVertexCounts = [4, 1000000]\n"
                      "int[] faceVertexIndices = [0, 1, 2, 3" +
                      indices + "]\n",
                  "1 warning: face");
}

TEST_F(BadInput, ASceneOfNothingIsRefused) {
    expectRefused("nothing.usda", "#usda 1.0\n", "nothing to light");
    expectRefused("invisible.usda",
                  "#usda 1.0\ndef Mesh \"M\"\n{\n    token visibility = \"invisible\"\n}\n",
                  "nothing to light");
}

TEST_F(BadInput, HugeAndTinyScenesAreLitOrRefusedButDoNotCrash) {
    for (const char* size : {"1e-30", "1e-12", "1e12", "1e30", "3e38"}) {
        const std::string s = size;
        const Outcome outcome = runPenumbra(
            {"solve",
             here.write("size.usda",
                        meshUnderLight("point3f[] points = [(0, 0, 0), (" + s + ", 0, 0), (" + s +
                                       ", " + s + ", 0), (0, " + s + ", 0)]\n" + kOneFace))},
            {.cpuSeconds = 30});
        EXPECT_TRUE(outcome.exitCode == 0 || outcome.exitCode == 1) << size << outcome.exitCode;
        EXPECT_THAT(outcome.err, testing::Not(IsEmpty()));
        EXPECT_LE(lineCount(outcome.err), 3u) << outcome.err;
    }
}

} // namespace

} // namespace penumbra
