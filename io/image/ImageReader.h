// Pictures from files of the usual kinds, for textures.
#pragma once

#include "scenegraph/TextureImage.h"

#include <cstddef>
#include <memory>
#include <span>
#include <string>

namespace penumbra {

/// What a picture's numbers mean: `automatic`: sRGB if it has 8 bits and three or four channels,
/// else linear (UsdUVTexture, sourceColorSpace).
enum class PictureCoding { automatic, raw, srgb };

/// Reads PNG, JPEG, OpenEXR, TIFF, Radiance HDR, BMP, TGA and WebP, told by their first bytes (TGA
/// by its name). Grey becomes three equal channels; alpha is left out and changes no colour. \param
/// bytes of the whole file \param name  of it, for people \throws Error if it is none of these,
/// damaged, or has more than kMostPixels
std::shared_ptr<const TextureImage> readImage(std::span<const std::byte> bytes,
                                              const std::string& name, PictureCoding coding);

constexpr std::size_t kMostPixels = 100'000'000;

} // namespace penumbra
