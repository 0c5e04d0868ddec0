#include "tests/support/Textures.h"

#include <gtest/gtest.h>

#include <random>

namespace penumbra {

namespace {

void expectNear(Rgb found, Rgb expected, float tolerance) {
    EXPECT_NEAR(found.r, expected.r, tolerance * std::max(expected.r, 0.05f));
    EXPECT_NEAR(found.g, expected.g, tolerance * std::max(expected.g, 0.05f));
    EXPECT_NEAR(found.b, expected.b, tolerance * std::max(expected.b, 0.05f));
}

std::shared_ptr<const TextureImage> noise(int width, int height, bool srgb) {
    std::mt19937 random(7);
    return picture(width, height, srgb, [&](int, int) {
        const auto byte = [&] { return std::uint8_t(random() % 256); };
        return std::array<std::uint8_t, 3>{byte(), byte(), byte()};
    });
}

Rgb meanOfLevel(const TextureImage& image, int level) {
    glm::dvec3 sum(0);
    for (int y = 0; y < image.height(level); ++y)
        for (int x = 0; x < image.width(level); ++x) {
            const Rgb v = image.texel(level, x, y);
            sum += glm::dvec3(v.r, v.g, v.b);
        }
    sum /= double(image.texels(level));
    return {float(sum.x), float(sum.y), float(sum.z)};
}

TEST(TextureImage, HasTheSameMeanOfLightAtEveryLevelWhateverItsSize) {
    for (const auto [width, height] : {std::pair{64, 64}, {37, 21}, {1, 19}, {100, 3}}) {
        const auto image = noise(width, height, true);
        const Rgb mean = meanOfLevel(*image, 0);
        for (int level = 0; level < image->levels(); ++level)
            expectNear(meanOfLevel(*image, level), mean, 1e-3f);
        expectNear(image->mean(), mean, 1e-3f);
    }
}

TEST(TextureImage, DecodesSrgbAndLeavesRawNumbersAsTheyAre) {
    const auto grey = [](int, int) { return std::array<std::uint8_t, 3>{188, 188, 188}; };
    // IEC 61966-2-1: ((188/255 + 0.055) / 1.055)^2.4 = 0.5029
    EXPECT_NEAR(picture(2, 2, true, grey)->texel(0, 0, 0).r, 0.5029f, 1e-4f);
    EXPECT_FLOAT_EQ(picture(2, 2, false, grey)->texel(0, 0, 0).r, 188 / 255.0f);
}

TEST(TextureImage, KeepsFloatsOfAnyRange) {
    const TextureImage image("lights", 2, 1, {0.01f, 1, 5000, -1, NAN, 20000});
    EXPECT_NEAR(image.texel(0, 0, 0).r, 0.01f, 2e-4f); // of 20000
    EXPECT_NEAR(image.texel(0, 0, 0).b, 5000, 1);
    EXPECT_EQ(image.texel(0, 1, 0).r, 0);
    EXPECT_EQ(image.texel(0, 1, 0).g, 0);
    EXPECT_FLOAT_EQ(image.texel(0, 1, 0).b, 20000);
}

TEST(Texture, MeansOverTrianglesAreThoseOfThePixelsInThem) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> place(-2, 3);
    for (const TextureWrap wrap :
         {TextureWrap::repeat, TextureWrap::mirror, TextureWrap::clamp, TextureWrap::black})
        for (int i = 0; i < 8; ++i) {
            // A parallelogram is two triangles of one size.
            const Texture texture{redAndWhite(4, 9), wrap, wrap};
            const glm::vec2 a(place(random), place(random));
            const glm::vec2 u(0.1f * place(random), 0.1f * place(random));
            const glm::vec2 v(0.1f * place(random), 0.1f * place(random));
            const Rgb one = texture.mean(std::array{a, a + u, a + u + v});
            const Rgb two = texture.mean(std::array{a, a + u + v, a + v});
            expectNear(0.5f * (one + two), pixelMean(texture, a, u, v), 0.02f);
        }
}

TEST(Texture, MeansOfMuchOfAFinePictureAreRightToATenthOfAPercent) {
    const Texture texture{noise(700, 500, true)};
    const glm::vec2 a(0.1f, 0.2f), u(0.6f, 0.1f), v(-0.1f, 0.7f);
    const Rgb one = texture.mean(std::array{a, a + u, a + u + v});
    const Rgb two = texture.mean(std::array{a, a + u + v, a + v});
    expectNear(0.5f * (one + two), pixelMean(texture, a, u, v, 2000), 3e-3f);
}

TEST(Texture, TakesWhatHasNoAreaAtItsMiddle) {
    const Texture texture{redAndWhite(2, 8)};
    const glm::vec2 uv(0.25f, 0.75f);
    EXPECT_EQ(texture.mean(std::array{uv, uv, uv}), texture.at(uv));
    // Beyond all measure, too: it ends, and is a mean.
    const float far = 1e30f;
    const Rgb wild =
        texture.mean(std::array{glm::vec2(-far, 0), glm::vec2(far, 1), glm::vec2(0, far)});
    EXPECT_TRUE(wild.r > 0 && wild.r < 1);
}

TEST(Texture, ItsLowerLeftCornerIsTheLastRowsFirstPixel) {
    const auto image = picture(4, 4, false, [](int x, int y) {
        return std::array<std::uint8_t, 3>{std::uint8_t(60 * x), std::uint8_t(60 * y), 0};
    });
    const Texture texture{image, TextureWrap::clamp, TextureWrap::clamp};
    EXPECT_EQ(texture.at({0, 0}), image->texel(0, 0, 3));
    EXPECT_EQ(texture.at({1, 1}), image->texel(0, 3, 0));
}

} // namespace

} // namespace penumbra
