#include "viewer/gl/OffscreenContext.h"

#include "base/Error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <thread>

namespace penumbra {

namespace {

TEST(OffscreenContext, NamesItsRenderer) {
    OffscreenContext context;
    EXPECT_THAT(context.description(), testing::HasSubstr(", OpenGL "));
}

TEST(OffscreenContext, OneMayEndWhileAnotherIsInUse) {
    auto first = std::make_unique<OffscreenContext>();
    OffscreenContext second;
    first.reset();
    second.makeCurrent();
    EXPECT_THAT(second.description(), testing::HasSubstr(", OpenGL "));
}

TEST(OffscreenContext, RefusesToBeCurrentInTwoThreads) {
    OffscreenContext context;
    std::thread([&] { EXPECT_THROW(context.makeCurrent(), Error); }).join();
}

TEST(OffscreenContextDeathTest, SaysInOneLineWhatToInstallWithoutADriver) {
    GTEST_FLAG_SET(death_test_style, "threadsafe"); // EGL of this process is loaded already
    const auto openWithoutDriver = [] {
        setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/nonexistent.json", 1);
        unsetenv("DISPLAY");
        try {
            OffscreenContext context;
        } catch (const Error& error) {
            std::fputs(error.what(), stderr);
            std::exit(1);
        }
        std::exit(0);
    };
    EXPECT_EXIT(openWithoutDriver(), testing::ExitedWithCode(1),
                "^off-screen rendering: [^\n]*apt install libegl1 libgl1-mesa-dri[^\n]*$");
}

} // namespace

} // namespace penumbra
