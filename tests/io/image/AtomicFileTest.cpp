#include "io/image/AtomicFile.h"

#include "ImageSamples.h"
#include "base/Error.h"

#include <gmock/gmock.h>

#include <sys/stat.h>
#include <unistd.h>

namespace penumbra {

namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

/// What the error says; empty if there is none.
std::string errorOf(const std::string& path, std::string_view text) {
    try {
        writeFileAtomically(path, text);
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

TEST(AtomicFile, WritesAndReplaces) {
    const TemporaryFolder folder;
    const std::string path = folder.file("a.txt");
    writeFileAtomically(path, "one, and rather long");
    writeFileAtomically(path, "two");
    EXPECT_EQ(contentOf(path), "two");
    EXPECT_EQ(folder.fileCount(), 1);
}

TEST(AtomicFile, WritesAnEmptyFile) {
    const TemporaryFolder folder;
    writeFileAtomically(folder.file("empty"), "");
    EXPECT_EQ(std::filesystem::file_size(folder.file("empty")), 0u);
}

TEST(AtomicFile, GivesThePermissionsThatTheUserWants) {
    const TemporaryFolder folder;
    const mode_t before = umask(027);
    writeFileAtomically(folder.file("a"), "x");
    umask(before);
    struct stat status {};
    ASSERT_EQ(stat(folder.file("a").c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777u, 0640u);
}

TEST(AtomicFile, LeavesTheOldFileAndNothingElseWhenTheDiskIsFull) {
    const TemporaryFolder folder;
    const std::string path = folder.file("a.txt");
    writeFileAtomically(path, "precious");
    std::string error;
    {
        const FileSizeLimit limit(1000);
        error = errorOf(path, std::string(5000, 'x'));
    }
    EXPECT_THAT(error, AllOf(StartsWith(path + ": error: can't write: "), Not(HasSubstr("\n"))));
    EXPECT_EQ(contentOf(path), "precious");
    EXPECT_EQ(folder.fileCount(), 1);
}

TEST(AtomicFile, SaysThatTheFolderIsMissing) {
    EXPECT_EQ(
        errorOf("/nonexistent/a.txt", "x"),
        "/nonexistent/a.txt: error: can't write: its folder does not exist (create it first)");
}

TEST(AtomicFile, SaysThatTheFolderTakesNoFiles) {
    EXPECT_EQ(errorOf("/proc/a.txt", "x"),
              "/proc/a.txt: error: can't write: its folder takes no files (choose another place)");
}

TEST(AtomicFile, SaysThatTheFolderMayNotBeWritten) {
    if (geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
    const TemporaryFolder folder;
    std::filesystem::permissions(folder.path(), std::filesystem::perms::owner_read |
                                                    std::filesystem::perms::owner_exec);
    EXPECT_THAT(errorOf(folder.file("a.txt"), "x"),
                HasSubstr("no permission (choose another place"));
    std::filesystem::permissions(folder.path(), std::filesystem::perms::owner_all);
}

TEST(AtomicFile, RefusesAFolderAsTarget) {
    const TemporaryFolder folder;
    EXPECT_THAT(errorOf(folder.path().string(), "x"), HasSubstr("it is a folder (name a file)"));
}

TEST(AtomicFile, NeverReplacesADevice) {
    // /dev/full takes no byte: writing to it fails as a full disk does.
    EXPECT_EQ(errorOf("/dev/full", "x"),
              "/dev/full: error: can't write: no space left on the device (free some space or "
              "choose another place)");
    EXPECT_EQ(errorOf("/dev/null", "x"), "");
    EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST(AtomicFile, SaysThatANameIsTooLongOrLeadsThroughAFile) {
    const TemporaryFolder folder;
    EXPECT_THAT(errorOf(folder.file(std::string(256, 'n')), "x"), HasSubstr("name is too long"));
    writeFileAtomically(folder.file("file"), "x");
    EXPECT_THAT(errorOf(folder.file("file/a.txt"), "x"), HasSubstr("is a file, not a folder"));
    EXPECT_EQ(folder.fileCount(), 1);
}

TEST(AtomicFile, LeavesACircleOfLinksAsItIs) {
    const TemporaryFolder folder;
    std::filesystem::create_symlink("b", folder.path() / "a");
    std::filesystem::create_symlink("a", folder.path() / "b");
    EXPECT_THAT(errorOf(folder.file("a"), "x"), HasSubstr("lead in a circle"));
    EXPECT_TRUE(std::filesystem::is_symlink(folder.path() / "a"));
    EXPECT_TRUE(std::filesystem::is_symlink(folder.path() / "b"));
}

TEST(AtomicFile, FollowsASymbolicLink) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder.path() / "there");
    std::filesystem::create_symlink("there/file", folder.path() / "link");
    for (const char* text : {"first", "second"}) { // dangling, then not
        writeFileAtomically(folder.file("link"), text);
        EXPECT_EQ(contentOf(folder.file("there/file")), text);
        EXPECT_TRUE(std::filesystem::is_symlink(folder.path() / "link"));
    }
}

TEST(AtomicFile, TakesNamesInTheCurrentFolderAndLongOnes) {
    const TemporaryFolder folder;
    const std::string name(255, 'n'); // the longest that Linux allows
    writeFileAtomically(folder.file(name), "x");
    EXPECT_EQ(contentOf(folder.file(name)), "x");
    const std::filesystem::path before = std::filesystem::current_path();
    std::filesystem::current_path(folder.path());
    writeFileAtomically("plain", "y");
    std::filesystem::current_path(before);
    EXPECT_EQ(contentOf(folder.file("plain")), "y");
}

} // namespace

} // namespace penumbra
