#include "io/usd/layer/SceneFolders.h"

#include "tests/io/usd/UsdTestFiles.h"

#include <gtest/gtest.h>

namespace penumbra {

namespace {

TEST(SceneFolders, HoldWhatLiesBesideOrBelowTheScene) {
    const TemporaryFolder here;
    const SceneFolders folders(here.path() / "scene/a.usda");
    EXPECT_TRUE(folders.hold(here.path() / "scene/a.usda"));
    EXPECT_TRUE(folders.hold(here.path() / "scene/parts/deep/b.usd"));
    EXPECT_TRUE(folders.hold(here.path() / "scene/parts/../b.usd"));
    EXPECT_FALSE(folders.hold(here.path() / "b.usd"));
    EXPECT_FALSE(folders.hold(here.path() / "scene/../b.usd"));
    EXPECT_FALSE(folders.hold(here.path() / "scene2/b.usd"));
    EXPECT_FALSE(folders.hold("/etc/passwd"));
    EXPECT_TRUE(SceneFolders().hold("/etc/passwd"));
}

TEST(SceneFolders, LinksCountWhereTheyLead) {
    const TemporaryFolder here;
    here.write("scene/a.usda", "#usda 1.0\n");
    here.write("else/b.usda", "#usda 1.0\n");
    std::filesystem::create_symlink(here.path() / "else/b.usda", here.path() / "scene/out.usda");
    std::filesystem::create_directory_symlink(here.path() / "else", here.path() / "scene/folder");
    const SceneFolders folders(here.path() / "scene/a.usda");
    EXPECT_FALSE(folders.hold(here.path() / "scene/out.usda"));
    EXPECT_FALSE(folders.hold(here.path() / "scene/folder/b.usda"));
    // A scene that is a link has its own neighbours, and those of what it leads to.
    const SceneFolders linked(here.path() / "scene/out.usda");
    EXPECT_TRUE(linked.hold(here.path() / "scene/a.usda"));
    EXPECT_TRUE(linked.hold(here.path() / "else/b.usda"));
}

TEST(SceneFolders, MoreFoldersCanBeAdded) {
    const TemporaryFolder here;
    SceneFolders folders(here.path() / "scene/a.usda");
    folders.add(here.path() / "else/b.usda");
    EXPECT_TRUE(folders.hold(here.path() / "else/c/d.png"));
    EXPECT_FALSE(folders.hold(here.path() / "third.png"));
}

} // namespace

} // namespace penumbra
