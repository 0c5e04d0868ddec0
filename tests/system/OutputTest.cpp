// Files that can't be written: reported early, and nothing half-written is left behind.
#include "Program.h"

#include <gmock/gmock.h>

#include <unistd.h>

namespace penumbra {

namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class Output : public testing::Test {
protected:
    Workplace here;
    std::string room = here.write("room.usda", smallRoom());

    Outcome render(const std::string& output, const RunLimits& limits = {}) {
        std::vector<std::string> arguments{"render",  room,  "-o",       output,
                                           "--width", "256", "--height", "144"};
        for (const std::string& word : coarse()) arguments.push_back(word);
        return runPenumbra(arguments, limits);
    }
    Outcome solve(const std::vector<std::string>& more, const RunLimits& limits = {}) {
        std::vector<std::string> arguments{"solve", room};
        for (const std::string& word : coarse()) arguments.push_back(word);
        arguments.insert(arguments.end(), more.begin(), more.end());
        return runPenumbra(arguments, limits);
    }
};

void expectOneLine(const Outcome& outcome, const std::string& text) {
    EXPECT_EQ(outcome.exitCode, 1);
    EXPECT_THAT(outcome.err, HasSubstr(text));
    EXPECT_THAT(outcome.err, HasSubstr("can't write"));
    EXPECT_EQ(lineCount(outcome.err), 1u) << outcome.err;
    EXPECT_THAT(outcome.out, IsEmpty());
}

TEST_F(Output, IntoAFolderThatDoesNotExistFailsAtOnce) {
    expectOneLine(render(here.path("none/a.exr")), "none/a.exr: error: can't write: no folder");
    EXPECT_THAT(here.files(), ElementsAre("room.usda"));
}

TEST_F(Output, IsNotLeftHalfWrittenWhenTheProgramIsTerminated) {
    // Ended as soon as a file appears that is being written: a picture of some megabytes takes a
    // while. Should it be whole before the signal comes, that is no fault.
    RunLimits limits;
    limits.endWhenItWritesInto = here.path("out");
    std::filesystem::create_directory(here.path("out"));
    const Outcome outcome =
        runPenumbra({"render", room, "-o", here.path("out/a.exr"), "--pixels", "float", "--width",
                     "512", "--patch-size", "0.5", "--element-size", "0.25", "--quiet"},
                    limits);
    EXPECT_THAT(outcome.exitCode, testing::AnyOf(-1, 0)) << outcome.err;
    for (const auto& file : std::filesystem::directory_iterator(here.path("out")))
        EXPECT_EQ(file.path().filename(), "a.exr");
}

TEST_F(Output, OntoAFolderFails) {
    std::filesystem::create_directory(here.path("a.exr"));
    expectOneLine(render(here.path("a.exr")), "a.exr: error: ");
}

TEST_F(Output, OntoAFullDiskFailsAndLeavesNothing) {
    expectOneLine(render(here.path("a.exr"), {.fileBytes = 10000}), "a.exr: ");
    EXPECT_THAT(here.files(), ElementsAre("room.usda"));
}

TEST_F(Output, OntoAFullDiskLeavesTheOldPictureWhole) {
    ASSERT_EQ(render(here.path("a.exr")).exitCode, 0);
    const std::string before = readFile(here.path("a.exr"));
    expectOneLine(render(here.path("a.exr"), {.fileBytes = 10000}), "a.exr: ");
    EXPECT_EQ(readFile(here.path("a.exr")), before);
    EXPECT_THAT(here.files(), ElementsAre("a.exr", "room.usda"));
}

TEST_F(Output, UnderANameThatCannotBeIsRefusedBeforeTheWork) {
    std::filesystem::create_symlink("loop.exr", here.path("loop.exr"));
    expectOneLine(render(here.path(std::string(300, 'n'))), "its name is too long (");
    expectOneLine(render(here.path("loop.exr")), "its symbolic links lead in a circle (");
    expectOneLine(render(here.path("room.usda/a.exr")), "is a file, not a folder (");
    EXPECT_THAT(here.files(), ElementsAre("loop.exr", "room.usda"));
}

TEST_F(Output, OntoADeviceThatIsFullFails) {
    expectOneLine(render("/dev/full"),
                  "/dev/full: error: can't write: no space left on the device (");
    expectOneLine(solve({"--quiet", "--stats", "/dev/full"}), "no space left on the device (");
}

TEST_F(Output, IntoAFolderWithoutPermissionFails) {
    if (geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
    std::filesystem::create_directory(here.path("locked"));
    std::filesystem::permissions(here.path("locked"), std::filesystem::perms::owner_read);
    expectOneLine(render(here.path("locked/a.exr")), "a.exr: error: can't write: no permission (");
}

TEST_F(Output, OfStatisticsAndValuesOntoAFullDiskFails) {
    std::string list = "x,y,z,nx,ny,nz\n";
    for (int i = 0; i < 30; ++i) list += "1,1,0,0,0,1\n"; // more than the disk holds
    const std::string sensors = here.write("in.csv", list);
    const std::string values = here.path("v.csv"), stats = here.path("s.json");
    expectOneLine(solve({"--quiet", "--stats", stats}, {.fileBytes = 400}), "s.json: ");
    expectOneLine(solve({"--quiet", "--sensors", sensors, "--values", values}, {.fileBytes = 400}),
                  "v.csv: ");
    EXPECT_THAT(here.files(), ElementsAre("in.csv", "room.usda"));
}

TEST_F(Output, OfValuesAndStatisticsIntoAFolderThatDoesNotExistFails) {
    const std::string sensors = here.write("in.csv", "x,y,z,nx,ny,nz\n1,1,0,0,0,1\n");
    expectOneLine(solve({"--quiet", "--stats", here.path("none/s.json")}), "none/s.json: ");
    expectOneLine(solve({"--quiet", "--sensors", sensors, "--values", here.path("none/v.csv")}),
                  "none/v.csv: ");
}

} // namespace

} // namespace penumbra
