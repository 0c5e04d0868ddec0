// Pictures for people: 8-bit sRGB as PNG.
#pragma once

#include "base/FrameLayers.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace penumbra {

/// Display values, linear in [0, 1], as 8-bit sRGB (IEC 61966-2-1), three bytes a pixel. Rounding
/// follows a fixed pattern (interleaved gradient noise; Jimenez, SIGGRAPH 2014 course "Advances in
/// Real-Time Rendering") which hides the steps in smooth shades; the same picture gives the same
/// bytes.
/// \param width of a row [pixel]
std::vector<std::uint8_t> displayBytes(std::span<const Rgb> shown, int width);

/// Writes the layer `shown`, which must be there, as a PNG file, whole or not at all (see
/// AtomicFile.h). \throws Error if the file can't be written
void writePng(const std::string& path, const FrameLayers& frame);

/// Writes 8-bit sRGB pixels, three bytes each, top row first, in the same way. \throws Error
void writePngBytes(const std::string& path, int width, int height,
                   std::span<const std::uint8_t> pixels);

} // namespace penumbra
