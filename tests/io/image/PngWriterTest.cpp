#include "io/image/PngWriter.h"

#include "ImageSamples.h"
#include "base/Error.h"

#include <png.h>

#include <cmath>
#include <limits>

namespace penumbra {

namespace {

FrameLayers flatFrame(Rgb colour, int width = 30, int height = 30) {
    FrameLayers frame(width, height);
    std::fill(frame.beauty.begin(), frame.beauty.end(), colour);
    frame.direct = frame.beauty;
    return frame;
}

TEST(PngWriter, TheFileHoldsTheToneMappedBytesAsSrgb) {
    const TemporaryFolder folder;
    const FrameLayers frame = sampleFrame(7, 4);
    writePng(folder.file("a.png"), frame);

    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    ASSERT_TRUE(png_image_begin_read_from_file(&image, folder.file("a.png").c_str()));
    EXPECT_EQ(image.width, 7u);
    EXPECT_EQ(image.height, 4u);
    EXPECT_EQ(image.format, png_uint_32(PNG_FORMAT_RGB));
    std::vector<std::uint8_t> pixels(7 * 4 * 3);
    ASSERT_TRUE(png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr));
    EXPECT_EQ(pixels, toneMappedBytes(frame, chooseExposure(frame)));
    EXPECT_NE(contentOf(folder.file("a.png")).find("sRGB"), std::string::npos);
}

TEST(PngWriter, AnEvenGreyPictureIsShownAsMiddleGrey) {
    // 18 % of white is 118 of 255 in sRGB (117.6), whatever the luminance.
    for (float nits : {0.001f, 50.0f, 1e6f}) {
        const FrameLayers frame = flatFrame(Rgb(nits));
        const auto bytes = toneMappedBytes(frame, chooseExposure(frame));
        double mean = 0;
        for (std::uint8_t byte : bytes) mean += byte / double(bytes.size());
        EXPECT_NEAR(mean, 117.6 + 0.0, 0.1);
    }
}

TEST(PngWriter, LightsInViewDoNotDarkenTheRoom) {
    FrameLayers room = flatFrame(Rgb(20), 100, 100);
    const float without = chooseExposure(room).middleGrey;
    std::fill_n(room.beauty.begin(), 4000, Rgb(10000)); // shining by themselves
    std::fill_n(room.direct.begin(), 4000, Rgb(0));
    EXPECT_FLOAT_EQ(chooseExposure(room).middleGrey, without);
}

TEST(PngWriter, ASpotOfBrightLightDoesNotDarkenTheRoom) {
    FrameLayers room = flatFrame(Rgb(20), 100, 100);
    const float without = chooseExposure(room).middleGrey;
    std::fill_n(room.direct.begin(), 90, Rgb(10000)); // less than 1 % of the picture
    EXPECT_FLOAT_EQ(chooseExposure(room).middleGrey, without);
}

TEST(PngWriter, APictureOfLightsAloneIsExposedForThem) {
    FrameLayers lights(10, 10);
    std::fill(lights.beauty.begin(), lights.beauty.end(), Rgb(5000));
    EXPECT_FLOAT_EQ(chooseExposure(lights).middleGrey, 5000);
}

TEST(PngWriter, BackgroundDoesNotBrightenTheRoom) {
    FrameLayers room = flatFrame(Rgb(20), 100, 100);
    std::fill_n(room.beauty.begin(), 5000, Rgb(0));
    std::fill_n(room.direct.begin(), 5000, Rgb(0));
    EXPECT_FLOAT_EQ(chooseExposure(room).middleGrey, 20);
}

TEST(PngWriter, ADarkRoomWithOneBrightWallIsExposedBetweenThem) {
    // By hand: of 79 pixels with 1 nit and 21 with 256 one each is cut off, so the logarithms are 0
    // (78 times) and 8 (20 times). mean = 160 / 98, lean = (2 mean - 0 - 8) / 8, and
    // middle grey = 2^mean * 4^-lean = 2^(2 + mean / 2).
    FrameLayers room = flatFrame(Rgb(1), 10, 10);
    std::fill_n(room.direct.begin(), 21, Rgb(256));
    const Exposure exposure = chooseExposure(room);
    EXPECT_NEAR(exposure.middleGrey, std::exp2(2 + 80.0 / 98), 1e-4);
    EXPECT_NEAR(exposure.white, 256, 1e-3);
}

TEST(PngWriter, ExposureCanBeGiven) {
    const FrameLayers frame = flatFrame(Rgb(20));
    const Exposure exposure = chooseExposure(frame, {.middleGrey = 5, .white = 400});
    EXPECT_EQ(exposure.middleGrey, 5);
    EXPECT_EQ(exposure.white, 400);
}

TEST(PngWriter, TonesRiseFromBlackToExactlyWhite) {
    const Exposure exposure{.middleGrey = 10, .white = 500};
    float last = 0;
    for (float nits = 0.01f; nits < 500; nits *= 1.1f) {
        const float shown = toneMapped(Rgb(nits), exposure).g;
        EXPECT_GT(shown, last);
        EXPECT_LT(shown, 1);
        last = shown;
    }
    EXPECT_NEAR(toneMapped(Rgb(500), exposure).g, 1, 1e-6);
    EXPECT_EQ(toneMapped(Rgb(0), exposure), Rgb(0));
    EXPECT_EQ(toneMapped(Rgb(1e30f), exposure), Rgb(1));
}

TEST(PngWriter, HueStaysAndColoursOutOfRangeKeepTheirLuminance) {
    const Exposure exposure{.middleGrey = 10, .white = 500};
    const Rgb dim = toneMapped({8, 4, 1}, exposure);
    EXPECT_NEAR(dim.r / dim.g, 2, 1e-5);
    EXPECT_NEAR(dim.g / dim.b, 4, 1e-5);

    const Rgb blue(0, 0, 300); // its display value would be far above 1 in blue
    const Rgb shown = toneMapped(blue, exposure);
    EXPECT_NEAR(shown.b, 1, 1e-6);
    EXPECT_GT(shown.r, 0); // mixed with grey,
    EXPECT_NEAR(luminance(shown), luminance(toneMapped(Rgb(luminance(blue)), exposure)), 1e-6);
}

TEST(PngWriter, DitherKeepsTheMeanAndNeverTouchesBlackOrWhite) {
    const Exposure exposure{.middleGrey = 0.18f, .white = 1}; // the identity
    for (double level : {100.25, 100.5, 100.9}) {
        const double encoded = level / 255;
        const double linear = std::pow((encoded + 0.055) / 1.055, 2.4);
        const auto bytes = toneMappedBytes(flatFrame(Rgb(float(linear)), 60, 60), exposure);
        double mean = 0;
        for (std::uint8_t byte : bytes) {
            EXPECT_TRUE(byte == 100 || byte == 101);
            mean += byte / double(bytes.size());
        }
        EXPECT_NEAR(mean, level, 0.01);
    }
    for (std::uint8_t byte : toneMappedBytes(flatFrame(Rgb(0)), exposure)) EXPECT_EQ(byte, 0);
    for (std::uint8_t byte : toneMappedBytes(flatFrame(Rgb(1)), exposure)) EXPECT_EQ(byte, 255);
}

TEST(PngWriter, PicturesOfNothingAndOfFaultyPixelsAreWritten) {
    const TemporaryFolder folder;
    writePng(folder.file("black.png"), FrameLayers(4, 4));
    FrameLayers faulty = flatFrame(Rgb(10), 4, 4);
    faulty.beauty[0].r = std::numeric_limits<float>::quiet_NaN();
    faulty.beauty[1].g = std::numeric_limits<float>::infinity();
    faulty.beauty[2] = Rgb(-1);
    writePng(folder.file("faulty.png"), faulty);
    EXPECT_EQ(folder.fileCount(), 2);
}

TEST(PngWriter, AFullDiskLeavesTheOldPicture) {
    const TemporaryFolder folder;
    const std::string path = folder.file("a.png");
    writePng(path, sampleFrame());
    const std::string before = contentOf(path);
    {
        const FileSizeLimit limit(100);
        EXPECT_THROW(writePng(path, sampleFrame(64, 64)), Error);
    }
    EXPECT_EQ(contentOf(path), before);
    EXPECT_EQ(folder.fileCount(), 1);
}

} // namespace

} // namespace penumbra
