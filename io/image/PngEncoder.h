// Pixels as the bytes of a PNG file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace penumbra {

/// A picture of 8-bit sRGB as a PNG file in memory; the file says that it is sRGB. The same pixels
/// give the same bytes.
/// \param pixels three bytes a pixel, top row first; width and height at least 1
/// \throws Error if it can't be made
std::vector<std::byte> encodePng(int width, int height, std::span<const std::uint8_t> pixels);

} // namespace penumbra
