#include "radiosity/process/snapshot/TextureCodec.h"

#include "tests/support/Textures.h"

#include <gtest/gtest.h>

#include <random>

namespace penumbra {

namespace {

std::vector<MaterialTextures> samples() {
    Texture tiles{
        redAndWhite(4, 8), TextureWrap::mirror, TextureWrap::black, {2, 1, 1}, {0, 0, 0.5f}};
    tiles.turn = glm::mat2(1, 2, 3, 4);
    tiles.shift = {5, 6};
    const auto lights =
        std::make_shared<TextureImage>("lights", 2, 1, std::vector<float>{1, 2, 3, 400, 5, 6});
    return {{std::make_shared<Texture>(tiles), nullptr},
            {},
            {std::make_shared<Texture>(tiles),
             std::make_shared<Texture>(Texture{lights, TextureWrap::clamp})}};
}

std::vector<std::byte> bytesOf(const std::vector<MaterialTextures>& textures,
                               std::size_t most = kMostTextureBytes) {
    ByteWriter out;
    writeTextures(out, textures, most);
    return out.take();
}

TEST(TextureCodec, BringsEverythingAcrossAndSharedPicturesOnce) {
    const auto before = samples();
    const auto bytes = bytesOf(before);
    ByteReader in(bytes);
    const auto after = readTextures(in, before.size());
    ASSERT_TRUE(in.ok() && in.atEnd());
    EXPECT_EQ(after[0].reflectance->image, after[2].reflectance->image);
    EXPECT_FALSE(after[1].any());
    for (const auto& [from, to] : {std::pair{before[0].reflectance, after[0].reflectance},
                                   {before[2].emission, after[2].emission}}) {
        Texture same = *to;
        same.image = from->image;
        EXPECT_EQ(same, *from);
        ASSERT_EQ(to->image->levels(), from->image->levels());
        for (int level = 0; level < from->image->levels(); ++level)
            EXPECT_EQ(to->image->texel(level, 0, 0), from->image->texel(level, 0, 0));
    }
}

TEST(TextureCodec, SendsCoarserPicturesWhereTheyWouldTakeTooMuch) {
    const auto before = samples();
    const auto bytes = bytesOf(before, 1000);
    EXPECT_LT(bytes.size(), 1500u);
    ByteReader in(bytes);
    const auto after = readTextures(in, before.size());
    ASSERT_TRUE(in.ok());
    EXPECT_LT(after[0].reflectance->image->width(), 32);
    EXPECT_NEAR(after[0].reflectance->mean().r, before[0].reflectance->mean().r, 1e-3f);
}

TEST(TextureCodec, TrustsNothing) {
    const auto good = bytesOf(samples());
    std::mt19937 random(11);
    for (int i = 0; i < 2000; ++i) {
        auto bytes = good;
        if (i % 2 == 0) bytes.resize(random() % bytes.size());
        for (int k = 0; k < 4 && !bytes.empty(); ++k) {
            const std::size_t at =
                random() % (i % 4 < 2 ? bytes.size() : std::min<std::size_t>(bytes.size(), 64));
            bytes[at] = std::byte(random());
        }
        ByteReader in(bytes);
        for (const MaterialTextures& textures : readTextures(in, 3))
            if (textures.reflectance) textures.reflectance->mean();
    }
}

} // namespace

} // namespace penumbra
