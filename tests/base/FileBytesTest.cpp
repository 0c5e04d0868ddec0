#include "base/FileBytes.h"

#include "base/Error.h"
#include "tests/support/TemporaryFolder.h"

#include <gtest/gtest.h>

namespace penumbra {

TEST(FileBytes, ACopyAndAMappedFileHaveTheSameBytes) {
    const TemporaryFolder folder;
    const std::string text(100'000, 'x');
    const auto file = folder.write("a", text);
    for (const std::uintmax_t mapFrom : {0u, 1'000'000u}) {
        const FileBytes bytes(file.string(), text.size(), mapFrom);
        const char* first = reinterpret_cast<const char*>(bytes.bytes().data());
        EXPECT_EQ(std::string(first, bytes.bytes().size()), text);
        EXPECT_EQ(reinterpret_cast<std::uintptr_t>(first) % FileBytes::kAlignment, 0u);
    }
}

TEST(FileBytes, AnEmptyFileHasNone) {
    const TemporaryFolder folder;
    EXPECT_TRUE(FileBytes(folder.write("a", "").string()).bytes().empty());
}

TEST(FileBytes, WhatCantBeReadIsAnError) {
    const TemporaryFolder folder;
    EXPECT_THROW(FileBytes(folder.file("none")), SceneFileError);
    EXPECT_THROW(FileBytes(folder.path().string()), SceneFileError);
    EXPECT_THROW(FileBytes("/dev/null"), SceneFileError);
    EXPECT_THROW(FileBytes(folder.write("a", "12345").string(), 4), SceneFileError);
}

} // namespace penumbra
