#include "io/image/PngWriter.h"

#include "ImageSamples.h"
#include "base/Error.h"

#include <png.h>

#include <cmath>
#include <vector>

namespace penumbra {

namespace {

FrameLayers shownFrame(Rgb shown, int width = 30, int height = 30) {
    FrameLayers frame(width, height);
    frame.shown.assign(frame.pixelCount(), shown);
    return frame;
}

TEST(PngWriter, TheFileHoldsWhatIsShownAsSrgb) {
    const TemporaryFolder folder;
    FrameLayers frame = sampleFrame(7, 4);
    for (const Rgb& colour : frame.beauty) frame.shown.push_back(colour * 0.005f);
    writePng(folder.file("a.png"), frame);

    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    ASSERT_TRUE(png_image_begin_read_from_file(&image, folder.file("a.png").c_str()));
    EXPECT_EQ(image.width, 7u);
    EXPECT_EQ(image.height, 4u);
    EXPECT_EQ(image.format, png_uint_32(PNG_FORMAT_RGB));
    std::vector<std::uint8_t> pixels(7 * 4 * 3);
    ASSERT_TRUE(png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr));
    EXPECT_EQ(pixels, displayBytes(frame.shown, 7));
    EXPECT_NE(contentOf(folder.file("a.png")).find("sRGB"), std::string::npos);
}

TEST(PngWriter, DitherKeepsTheMeanAndNeverTouchesBlackOrWhite) {
    for (double level : {100.25, 100.5, 100.9}) {
        const double encoded = level / 255;
        const double linear = std::pow((encoded + 0.055) / 1.055, 2.4);
        const auto bytes = displayBytes(std::vector<Rgb>(3600, Rgb(float(linear))), 60);
        double mean = 0;
        for (std::uint8_t byte : bytes) {
            EXPECT_TRUE(byte == 100 || byte == 101);
            mean += byte / double(bytes.size());
        }
        EXPECT_NEAR(mean, level, 0.01);
    }
    for (std::uint8_t byte : displayBytes(std::vector<Rgb>(900, Rgb(0)), 30)) EXPECT_EQ(byte, 0);
    for (std::uint8_t byte : displayBytes(std::vector<Rgb>(900, Rgb(1)), 30)) EXPECT_EQ(byte, 255);
}

TEST(PngWriter, AFullDiskLeavesTheOldPicture) {
    const TemporaryFolder folder;
    const std::string path = folder.file("a.png");
    writePng(path, shownFrame(Rgb(0.5f), 5, 3));
    const std::string before = contentOf(path);
    {
        const FileSizeLimit limit(100);
        EXPECT_THROW(writePng(path, shownFrame(Rgb(0.3f), 64, 64)), Error);
    }
    EXPECT_EQ(contentOf(path), before);
    EXPECT_EQ(folder.fileCount(), 1);
}

} // namespace

} // namespace penumbra
