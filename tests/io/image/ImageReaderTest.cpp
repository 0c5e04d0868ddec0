#include "io/image/ImageReader.h"

#include "base/Error.h"
#include "io/image/PngEncoder.h"

#include <gtest/gtest.h>

#include <random>
#include <string>

namespace penumbra {

namespace {

std::vector<std::byte> samplePng() {
    std::vector<std::uint8_t> pixels;
    for (int i = 0; i < 3 * 20 * 10; ++i) pixels.push_back(std::uint8_t(i * 7));
    return encodePng(20, 10, pixels);
}

/// An uncompressed TGA of grey pixels.
std::vector<std::byte> greyTga() {
    std::vector<std::uint8_t> bytes{0, 0, 3, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 1, 0, 8, 0x20};
    bytes.insert(bytes.end(), {51, 204});
    std::vector<std::byte> file(bytes.size());
    for (std::size_t i = 0; i < bytes.size(); ++i) file[i] = std::byte(bytes[i]);
    return file;
}

TEST(ImageReader, ReadsPixelsFromTheTopRowAsTheyAre) {
    const auto image = readImage(samplePng(), "a.png", PictureCoding::raw);
    ASSERT_EQ(image->width(), 20);
    ASSERT_EQ(image->height(), 10);
    EXPECT_EQ(image->texel(0, 1, 0), Rgb(21 / 255.0f, 28 / 255.0f, 35 / 255.0f));
    EXPECT_EQ(image->texel(0, 0, 1).r, float(std::uint8_t(60 * 7)) / 255);
}

TEST(ImageReader, TakesThreeChannelsAsSrgbAndOneAsRawIfNobodySays) {
    EXPECT_TRUE(readImage(samplePng(), "a.png", PictureCoding::automatic)->srgb());
    EXPECT_FALSE(readImage(samplePng(), "a.png", PictureCoding::raw)->srgb());
    const auto grey = readImage(greyTga(), "a.tga", PictureCoding::automatic);
    EXPECT_FALSE(grey->srgb());
    EXPECT_EQ(grey->texel(0, 0, 0), Rgb(0.2f));
    EXPECT_EQ(grey->texel(0, 1, 0), Rgb(0.8f));
    EXPECT_TRUE(readImage(greyTga(), "a.tga", PictureCoding::srgb)->srgb());
}

TEST(ImageReader, RefusesWhatIsNoPictureInALine) {
    for (const char* text : {"", "x", "\x89PNG", "BM", "#?RADIANCE\n", "v/1\x01 no more"}) {
        const std::string bytes = text;
        try {
            readImage(std::as_bytes(std::span(bytes)), "odd.bin", PictureCoding::automatic);
            ADD_FAILURE() << text;
        } catch (const Error& error) {
            EXPECT_EQ(std::string(error.what()).rfind("odd.bin", 0), 0u);
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
        }
    }
}

TEST(ImageReader, SurvivesDamage) {
    std::mt19937 random(5);
    for (const auto& [file, name] :
         {std::pair{samplePng(), "a.png"}, std::pair{greyTga(), "a.tga"}})
        for (int i = 0; i < 300; ++i) {
            std::vector<std::byte> bytes = file;
            if (i % 2 == 0) bytes.resize(random() % bytes.size());
            for (int k = 0; k < 3 && !bytes.empty(); ++k)
                bytes[random() % bytes.size()] = std::byte(random());
            try {
                readImage(bytes, name, PictureCoding::automatic);
            } catch (const Error&) { // said, and nothing else happens
            }
        }
}

} // namespace

} // namespace penumbra
