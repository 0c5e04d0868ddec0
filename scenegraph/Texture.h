// A picture as a surface wears it.
#pragma once

#include "base/Rgb.h"
#include "scenegraph/TextureImage.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <memory>
#include <span>

namespace penumbra {

/// What is outside of the picture: it repeats, is mirrored, its border goes on, or black.
enum class TextureWrap : std::uint8_t { repeat, mirror, clamp, black };

/// A function of texture coordinates, with values that are not negative:
///
///     max(0, scale * picture(turn * uv + shift) + bias)
///
/// (0, 0) is the picture's lower left corner, (1, 1) its upper right one (UsdUVTexture).
struct Texture {
    std::shared_ptr<const TextureImage> image;
    TextureWrap wrapS = TextureWrap::repeat, wrapT = TextureWrap::repeat;
    Rgb scale{1}, bias{0};
    glm::mat2 turn{1.0f};
    glm::vec2 shift{0.0f};

    /// In full resolution, interpolated between texels.
    Rgb at(glm::vec2 uv) const;
    /// Mean over all of the picture.
    Rgb mean() const;
    /// Area-true mean over a triangle of texture coordinates: of texels as little squares, at a
    /// level of the pyramid at which it is some kMostAcross texels wide; exact where that is the
    /// finest level. A triangle without area gives the value in its middle.
    Rgb mean(std::span<const glm::vec2, 3> triangle) const;

    static constexpr int kMostAcross = 24; ///< texels

    friend bool operator==(const Texture&, const Texture&) = default;
};

} // namespace penumbra
