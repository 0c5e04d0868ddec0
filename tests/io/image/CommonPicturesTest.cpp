// JPEG and PNG by their own libraries: what OpenImageIO would have read.
#include "io/image/CommonPictures.h"
#include "io/image/PngEncoder.h"

#include <gtest/gtest.h>

#include <dlfcn.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace penumbra {

namespace {

namespace fs = std::filesystem;

std::vector<std::byte> bytesOf(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    const auto bytes = std::as_bytes(std::span(text));
    return {bytes.begin(), bytes.end()};
}

DecodePicture* openImageIO() {
    const fs::path file =
        fs::read_symlink("/proc/self/exe").parent_path() / "libpenumbra_pictures.so";
    void* const library = dlopen(file.c_str(), RTLD_LAZY | RTLD_LOCAL);
    return library ? reinterpret_cast<DecodePicture*>(dlsym(library, kDecodePicture)) : nullptr;
}

TEST(CommonPictures, ReadsPixelsOfPng) {
    std::vector<std::uint8_t> pixels;
    for (int i = 0; i < 3 * 20 * 10; ++i) pixels.push_back(std::uint8_t(i * 7));
    const auto picture = decodeCommon(encodePng(20, 10, pixels));
    ASSERT_TRUE(picture);
    EXPECT_EQ(picture->width, 20);
    EXPECT_EQ(picture->height, 10);
    EXPECT_EQ(picture->channels, 3);
    EXPECT_EQ(picture->bytes, pixels);
}

TEST(CommonPictures, LeavesDamageToOthers) {
    std::vector<std::byte> png = encodePng(20, 10, std::vector<std::uint8_t>(600, 90));
    png.resize(png.size() / 2);
    EXPECT_FALSE(decodeCommon(png));
    for (const std::string text : {"", "\xff", "\xff\xd8\xff", "\x89PNG"})
        EXPECT_FALSE(decodeCommon(std::as_bytes(std::span(text)))) << text.size();
}

/// Pictures that others made, whatever wrote them.
TEST(CommonPictures, AreTheSameAsByOpenImageIO) {
    const fs::path assets = fs::path(PENUMBRA_SOURCE_DIR) / "../shared/assets";
    if (!fs::exists(assets)) GTEST_SKIP() << "no ../shared/assets";
    DecodePicture* const decode = openImageIO();
    ASSERT_NE(decode, nullptr);
    std::size_t read = 0, all = 0;
    for (const auto& entry : fs::recursive_directory_iterator(assets)) {
        const std::string end = entry.path().extension();
        const bool jpeg = end == ".jpg" || end == ".jpeg";
        if ((!jpeg && end != ".png") || entry.file_size() > 2'000'000 || all == 60) continue;
        ++all;
        const std::vector<std::byte> bytes = bytesOf(entry.path());
        const auto own = decodeCommon(bytes);
        if (!own) continue;
        ++read;
        DecodedPicture other;
        decode(bytes, entry.path().filename(), jpeg ? "jpeg" : "png", other);
        ASSERT_EQ(other.fault, "") << entry.path();
        EXPECT_EQ(own->width, other.width) << entry.path();
        EXPECT_EQ(own->channels, other.channels) << entry.path();
        EXPECT_TRUE(own->bytes == other.bytes) << entry.path();
    }
    EXPECT_GT(2 * read, all);
}

} // namespace

} // namespace penumbra
