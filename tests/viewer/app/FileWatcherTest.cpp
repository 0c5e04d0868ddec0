// Noticing that somebody has saved a file again.
#include "viewer/app/FileWatcher.h"

#include "tests/support/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <fstream>

namespace penumbra {

namespace {

class FileWatcherTest : public testing::Test {
protected:
    void SetUp() override { touch(0); }
    void touch(int seconds) {
        std::ofstream(file) << seconds;
        std::filesystem::last_write_time(file, start + std::chrono::seconds(seconds));
    }
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.file("scene.usda");
    const std::filesystem::file_time_type start = std::filesystem::file_time_type::clock::now();
};

TEST_F(FileWatcherTest, SaysOnceThatAFileHasChangedWhenItHasComeToRest) {
    FileWatcher watcher({file});
    EXPECT_FALSE(watcher.changed(1));
    touch(1);
    EXPECT_FALSE(watcher.changed(2)) << "it may still be being written";
    touch(2);
    EXPECT_FALSE(watcher.changed(3));
    EXPECT_TRUE(watcher.changed(4));
    EXPECT_FALSE(watcher.changed(5));
}

TEST_F(FileWatcherTest, WaitsForAFileThatIsBeingReplaced) {
    FileWatcher watcher({file});
    std::filesystem::remove(file);
    for (int i = 1; i < 5; ++i) EXPECT_FALSE(watcher.changed(i));
    touch(9);
    EXPECT_FALSE(watcher.changed(6));
    EXPECT_TRUE(watcher.changed(7));
}

TEST_F(FileWatcherTest, LooksNotMoreOftenThanItSays) {
    FileWatcher watcher({file});
    watcher.changed(1);
    touch(1);
    watcher.changed(1.1);
    watcher.changed(1.2);
    EXPECT_FALSE(watcher.changed(1.3));
    EXPECT_FALSE(FileWatcher().changed(1)) << "of nothing";
}

} // namespace

} // namespace penumbra
