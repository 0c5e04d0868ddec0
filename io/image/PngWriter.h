// Pictures for people: tone-mapped PNG.
#pragma once

#include "base/FrameLayers.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace penumbra {

struct ToneOptions {
    /// Luminance that is shown as 18 % grey [nit], more than 0; unset: chosen from the picture. A
    /// photographer's exposure value (at ISO 100) is log2(8 * middleGrey).
    std::optional<float> middleGrey;
    /// Luminance that is just shown as white [nit]; unset: chosen from the picture.
    std::optional<float> white;
};

/// How luminances become tones.
struct Exposure {
    float middleGrey = 1; ///< [nit], more than 0
    float white = 10;     ///< [nit], at least middleGrey / 0.18
};

/// Exposure for a picture, by the parameters of the photographic operator: the middle grey follows
/// the geometric mean of the luminances and leans to the brighter or the darker end as the picture
/// does; white is the brightest of them. What counts is reflected light (the direct and indirect
/// layers), so that lamps in view do not darken the room, and of that not the darkest and brightest
/// 1 %. A picture of lamps alone is judged by its beauty. `options` overrides either value.
///
/// Reinhard et al., "Photographic Tone Reproduction for Digital Images", SIGGRAPH 2002;
/// Reinhard, "Parameter Estimation for Photographic Tone Reproduction", J. Graphics Tools 7(1),
/// 2002.
Exposure chooseExposure(const FrameLayers& frame, const ToneOptions& options = {});

/// Display value of a luminance, linear, each channel in [0, 1]:
///
///     L = 0.18 Y / middleGrey,  Lw = 0.18 white / middleGrey,  Ld = L (1 + L / Lw^2) / (1 + L)
///
/// with Y the colour's luminance. All channels are scaled alike, so hue and saturation stay; a
/// colour that the display can't reach at this luminance is mixed with grey of the same luminance.
/// (Reinhard et al. 2002, equation 4.)
Rgb toneMapped(Rgb colour, const Exposure& exposure);

/// Exposure for the reflected luminances [nit] of a picture, as above; what is not positive is left
/// out. With nothing left a middle grey of 1.
Exposure chooseExposure(std::span<const float> luminances);

/// Display values, linear in [0, 1], as 8-bit sRGB (IEC 61966-2-1), three bytes a pixel. Rounding
/// follows a fixed pattern (interleaved gradient noise; Jimenez, SIGGRAPH 2014 course "Advances in
/// Real-Time Rendering") which hides the steps in smooth shades; the same picture gives the same
/// bytes.
/// \param width of a row [pixel]
std::vector<std::uint8_t> displayBytes(std::span<const Rgb> shown, int width);

/// The picture, tone mapped, by displayBytes(); top row first.
std::vector<std::uint8_t> toneMappedBytes(const FrameLayers& frame, const Exposure& exposure);

/// Writes the beauty layer as a PNG file, whole or not at all (see AtomicFile.h).
/// \throws Error if the file can't be written
void writePng(const std::string& path, const FrameLayers& frame, const ToneOptions& options = {});

/// Writes 8-bit sRGB pixels, three bytes each, top row first, in the same way. \throws Error
void writePngBytes(const std::string& path, int width, int height,
                   std::span<const std::uint8_t> pixels);

} // namespace penumbra
