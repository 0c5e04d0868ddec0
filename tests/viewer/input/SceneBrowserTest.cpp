// Walking through folders to a file that can be opened.
#include "viewer/input/SceneBrowser.h"

#include "tests/support/TemporaryFolder.h"

#include <gmock/gmock.h>

namespace penumbra {

namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(SceneBrowser, ListsFoldersAndWhatCanBeOpened) {
    const TemporaryFolder disk;
    disk.write("b.usda", "");
    disk.write("A.USDZ", "");
    disk.write("model.glb", "");
    disk.write("note.txt", "");
    disk.write(".hidden.usda", "");
    disk.write("rooms/one.usd", "");
    SceneBrowser browser(disk.path());
    EXPECT_THAT(browser.folders(), ElementsAre("rooms"));
    EXPECT_THAT(browser.files(), ElementsAre("A.USDZ", "b.usda", "model.glb"));
    browser.go("rooms");
    EXPECT_THAT(browser.folders(), IsEmpty());
    EXPECT_THAT(browser.files(), ElementsAre("one.usd"));
    browser.go("..");
    EXPECT_THAT(browser.folders(), ElementsAre("rooms"));
}

TEST(SceneBrowser, StaysWhereItIsIfAFolderCantBeRead) {
    const TemporaryFolder disk;
    disk.write("b.usda", "");
    SceneBrowser browser(disk.path());
    browser.go("gone");
    EXPECT_THAT(browser.fault(), HasSubstr("gone"));
    EXPECT_THAT(browser.files(), ElementsAre("b.usda"));
    browser.go(".");
    EXPECT_THAT(browser.fault(), IsEmpty());
}

TEST(SceneBrowser, BeginsInThePresentFolderIfItsOwnIsGone) {
    const SceneBrowser browser("/nowhere/at/all");
    EXPECT_EQ(browser.folder(), std::filesystem::canonical(std::filesystem::current_path()));
    EXPECT_THAT(browser.fault(), IsEmpty());
}

} // namespace

} // namespace penumbra
