// Pictures made by hand, and what they say by the definition.
#pragma once

#include "scenegraph/Material.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace penumbra {

/// A picture of 8 bits: `colour` gives three bytes for a column and a row, row 0 at the top.
inline std::shared_ptr<const TextureImage>
picture(int width, int height, bool srgb,
        const std::function<std::array<std::uint8_t, 3>(int, int)>& colour) {
    std::vector<std::uint8_t> rgb;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (const std::uint8_t v : colour(x, y)) rgb.push_back(v);
    return std::make_shared<TextureImage>("picture", width, height, std::move(rgb), srgb);
}

/// `tiles` x `tiles` red and white tiles of `size` pixels.
inline std::shared_ptr<const TextureImage> redAndWhite(int tiles, int size, bool srgb = true) {
    return picture(tiles * size, tiles * size, srgb, [=](int x, int y) {
        const bool red = (x / size + y / size) % 2 == 0;
        return red ? std::array<std::uint8_t, 3>{200, 20, 20}
                   : std::array<std::uint8_t, 3>{235, 235, 235};
    });
}

/// Value of the pixel at texture coordinates, wrapped; pixels are little squares. Says the same as
/// Texture::at(), without interpolation, in other words.
inline Rgb pixelAt(const Texture& texture, glm::dvec2 uv) {
    const glm::dvec2 at(glm::dvec2(texture.turn * glm::vec2(uv)) + glm::dvec2(texture.shift));
    const auto wrap = [](double t, TextureWrap mode) -> double {
        switch (mode) {
        case TextureWrap::repeat:
            return t - std::floor(t);
        case TextureWrap::mirror: {
            const double period = t - 2 * std::floor(t / 2);
            return period < 1 ? period : 2 - period;
        }
        case TextureWrap::clamp:
            return std::min(std::max(t, 0.0), 1.0);
        case TextureWrap::black:
            break;
        }
        return t < 0 || t >= 1 ? -1 : t;
    };
    const double s = wrap(at.x, texture.wrapS), t = wrap(at.y, texture.wrapT);
    if (s < 0 || t < 0) return texture.bias;
    const TextureImage& image = *texture.image;
    const int x = std::min(int(s * image.width()), image.width() - 1);
    const int y = std::min(int((1 - t) * image.height()), image.height() - 1);
    return texture.scale * image.texel(0, x, y) + texture.bias;
}

/// Mean of pixelAt() over a parallelogram of texture coordinates, by side * side points.
inline Rgb pixelMean(const Texture& texture, glm::dvec2 corner, glm::dvec2 along, glm::dvec2 across,
                     int side = 400) {
    glm::dvec3 sum(0);
    for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i) {
            const Rgb value =
                pixelAt(texture, corner + (i + 0.5) / side * along + (j + 0.5) / side * across);
            sum += glm::dvec3(value.r, value.g, value.b);
        }
    sum /= double(side) * side;
    return {float(sum.x), float(sum.y), float(sum.z)};
}

inline std::shared_ptr<Material> papered(Texture texture, Rgb factor = Rgb(1)) {
    auto material = std::make_shared<Material>(
        "papered", MaterialTextures{std::make_shared<Texture>(std::move(texture)), nullptr});
    material->setReflectance(factor);
    return material;
}

} // namespace penumbra
