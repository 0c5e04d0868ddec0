// A recording is safe on disk, and the walk goes on when the disk is not there for it.
#include "viewer/app/SessionFile.h"

#include "base/Error.h"
#include "tests/support/TemporaryFolder.h"
#include "viewer/input/Walkthrough.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace penumbra {

namespace {

const std::string kScene = PENUMBRA_SOURCE_DIR "/scenes/cornell.usda";

ReadyScene cornell() {
    ReadyScene ready;
    ready.loaded = loadUsdScene(kScene);
    ready.placed = placeScene(*ready.loaded.scene);
    ready.rays = std::make_unique<SceneRays>(ready.placed);
    return ready;
}

/// Records a while, longer than from one writing to the next; the messages about troubles.
std::string walkAbout(Walkthrough& walk, SessionFile& session) {
    std::string said;
    walk.take(KeyEvent{.key = key('W'), .down = true}, {800, 600});
    for (double time = 0; time < 1.5 * SessionFile::kSaveSeconds; time += 0.25) {
        walk.advance(0.25);
        said += session.take(walk).value_or("");
    }
    return said;
}

TEST(SessionFile, IsThereFromTheStartAndGrows) {
    const TemporaryFolder folder;
    const std::string layer = folder.file("take.usda");
    Walkthrough walk(cornell());
    SessionFile session(walk, kScene, layer);
    const auto atFirst = std::filesystem::file_size(layer);
    EXPECT_EQ(walkAbout(walk, session), "");
    EXPECT_GT(std::filesystem::file_size(layer), atFirst);
    session.finish();
    EXPECT_EQ(folder.fileCount(), 1) << "nothing is left beside it";
}

TEST(SessionFile, GoesOnWhenItCanNotBeWrittenAndIsWholeOnceItCan) {
    const TemporaryFolder folder;
    const std::filesystem::path disk = folder.path() / "disk";
    const std::string layer = (disk / "take.usda").string();
    std::filesystem::create_directory(disk);
    Walkthrough walk(cornell());
    SessionFile session(walk, kScene, layer);
    std::filesystem::remove_all(disk);
    EXPECT_NE(walkAbout(walk, session).find(layer), std::string::npos) << "says where";
    std::filesystem::create_directory(disk);
    session.finish();
    const LoadedScene whole = loadUsdScene(layer);
    EXPECT_GT(whole.scene->endTimeCode - whole.scene->startTimeCode, 24 * SessionFile::kSaveSeconds)
        << "in frames, of which a second has 24 at least";
}

TEST(SessionFile, SaysAtTheStartAndAtTheEndThatItCanNotBeWritten) {
    const TemporaryFolder folder;
    const std::filesystem::path disk = folder.path() / "disk";
    const std::string layer = (disk / "take.usda").string();
    Walkthrough walk(cornell());
    EXPECT_THROW(SessionFile(walk, kScene, layer), Error);
    std::filesystem::create_directory(disk);
    SessionFile session(walk, kScene, layer);
    std::filesystem::remove_all(disk);
    walk.advance(0.25);
    session.take(walk);
    EXPECT_THROW(session.finish(), Error);
}

} // namespace

} // namespace penumbra
