// Textures as OpenGL draws them.
#include "tests/support/Textures.h"
#include "tests/viewer/gl/LitScenes.h"

namespace penumbra {

namespace {

using Textured = WithContext;

LitMeshData texturedSquare(const Texture& reflectance) {
    LitMeshData data = litSquare({Rgb(0.5f), {}, {std::make_shared<Texture>(reflectance), {}}});
    data.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    return data;
}

std::shared_ptr<const TextureImage> gradient(bool srgb) {
    return picture(8, 8, srgb, [](int x, int y) {
        return std::array<std::uint8_t, 3>{std::uint8_t(30 * x), std::uint8_t(30 * y), 90};
    });
}

// Drivers place samples to a fraction of a texel, and neighbours differ by up to 0.1 here.
constexpr float kNear = 0.01f;

TEST_F(Textured, TheAlbedoOfEachPixelIsThatOfThePicture) {
    for (const bool srgb : {true, false}) {
        Texture texture{gradient(srgb), TextureWrap::clamp, TextureWrap::clamp};
        texture.scale = {0.5f, 1, 0.9f};
        texture.bias = {0.1f, 0, 0};
        texture.turn = glm::mat2(0.5f, 0.2f, -0.3f, 0.7f);
        texture.shift = {0.2f, 0.05f};
        Group scene("scene");
        scene.add(litNode(texturedSquare(texture)));
        const FrameLayers frame =
            renderFrame(*context, renderer, scene, viewFrom(1, 64, 64), 64, 64);
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 64; ++x) {
                const glm::vec2 uv((float(x) + 0.5f) / 64, 1 - (float(y) + 0.5f) / 64);
                const Rgb expected = 0.5f * texture.at(uv);
                const std::size_t at = frame.index(x, y);
                EXPECT_NEAR(frame.albedo[at].r, expected.r, kNear) << x << ' ' << y;
                EXPECT_NEAR(frame.albedo[at].g, expected.g, kNear) << x << ' ' << y;
                EXPECT_NEAR(frame.albedo[at].b, expected.b, kNear) << x << ' ' << y;
            }
    }
}

TEST_F(Textured, FarAwayItIsTheMeanOfLight) {
    const Texture tiles{redAndWhite(16, 4)};
    Group scene("scene");
    scene.add(litNode(texturedSquare(tiles)));
    const FrameLayers frame = renderFrame(*context, renderer, scene, viewFrom(8, 17, 17), 17, 17);
    const Rgb found = frame.albedo[frame.index(8, 8)], mean = 0.5f * tiles.mean();
    EXPECT_NEAR(found.r, mean.r, 0.03f * mean.r);
    EXPECT_NEAR(found.g, mean.g, 0.03f * mean.g);
}

} // namespace

} // namespace penumbra
