// What the walkthrough remembers.
#include "viewer/app/ViewerSettings.h"

#include "tests/support/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace penumbra {

namespace {

ViewerSettings unusual() {
    return {.width = 1111,
            .height = 777,
            .panels = false,
            .tone = ToneStyle::srgb,
            .compensation = -1.25f,
            .walkSpeed = 2.5,
            .eyeHeight = 1.2,
            .sensitivity = 0.3,
            .gravity = false,
            .collision = true,
            .trigger = Trigger::onDemand,
            .recent = {"/rooms/a room.usda", "/b.glb"}};
}

TEST(ViewerSettings, ComeBackAsTheyWereWritten) {
    EXPECT_EQ(settingsFrom(textOf(unusual())), unusual());
    EXPECT_EQ(settingsFrom(textOf({})), ViewerSettings{});
}

TEST(ViewerSettings, RememberTheLatestScenesEachOnce) {
    ViewerSettings settings;
    for (const char* file : {"/a.usda", "/b.usda", "/rooms/../a.usda"}) addRecent(settings, file);
    EXPECT_EQ(settings.recent, (std::vector<std::string>{"/a.usda", "/b.usda"}));
    for (int i = 0; i < 20; ++i) addRecent(settings, "/" + std::to_string(i) + ".usda");
    EXPECT_EQ(settings.recent.size(), kMostRecent);
    EXPECT_EQ(settings.recent.front(), "/19.usda");
    addRecent(settings, "/two\nlines.usda"); // would be garbled
    EXPECT_EQ(settings.recent.front(), "/19.usda");
}

TEST(ViewerSettings, TheFirstWindowFitsASmallScreenWithItsFrameAndATaskBar) {
    EXPECT_LE(ViewerSettings{}.width, 1280);
    EXPECT_LE(ViewerSettings{}.height, 720 - 80);
}

TEST(ViewerSettings, WhatIsGarbledKeepsItsDefault) {
    const ViewerSettings settings =
        settingsFrom("width = lots\nheight = -5\ntone = 77\n= =\ngravity = 0\nnonsense = 3\n\x01\n"
                     "walkSpeed = nan\neyeHeight 3\nsensitivity = 2x\n");
    ViewerSettings expected;
    expected.gravity = false;
    EXPECT_EQ(settings, expected);
}

TEST(ViewerSettings, LieWhereXdgSays) {
    const TemporaryFolder parent;
    const std::string folder = parent.file("settings");
    setenv("XDG_CONFIG_HOME", folder.c_str(), 1);
    EXPECT_EQ(settingsFile(), folder + "/penumbra/viewer.conf");
    EXPECT_TRUE(saveSettings(unusual()));
    EXPECT_EQ(loadSettings(), unusual());
    std::filesystem::remove_all(folder);
    EXPECT_EQ(loadSettings(), ViewerSettings{}) << "no file, no error";
    setenv("XDG_CONFIG_HOME", "relative", 1); // must be ignored
    setenv("HOME", "/dev/null", 1);           // where not even root can write
    EXPECT_EQ(settingsFile(), "/dev/null/.config/penumbra/viewer.conf");
    EXPECT_FALSE(saveSettings({}));
}

} // namespace

} // namespace penumbra
