#include "comparison/ReportImages.h"

#include "io/image/Exposure.h"
#include "io/image/PngEncoder.h"
#include "io/image/PngWriter.h"
#include "io/image/ToneCurve.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <vector>

namespace penumbra {

namespace {

using Colour = std::array<std::uint8_t, 3>;

/// Evenly spaced on a logarithmic scale from 1/4 to 16 JND.
constexpr std::array<Colour, 4> kScale = {
    {{10, 10, 20}, {50, 80, 190}, {240, 140, 40}, {255, 255, 235}}};
constexpr double kLeast = 0.25, kMost = 16;

Colour differenceColour(double jnd) {
    const double t = std::log(std::max(jnd, kLeast) / kLeast) / std::log(kMost / kLeast);
    const double at = std::clamp(t, 0.0, 1.0) * double(kScale.size() - 1);
    const auto i = std::min(std::size_t(at), kScale.size() - 2);
    Colour colour{};
    for (std::size_t c = 0; c < 3; ++c)
        colour[c] = std::uint8_t(
            std::lround(std::lerp(double(kScale[i][c]), double(kScale[i + 1][c]), at - double(i))));
    return colour;
}

std::string pngUri(int width, int height, std::span<const std::uint8_t> pixels) {
    return "data:image/png;base64," + base64(encodePng(width, height, pixels));
}

} // namespace

std::string base64(std::span<const std::byte> bytes) {
    constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 3; ++k)
            group = group << 8 | (i + k < bytes.size() ? std::uint32_t(bytes[i + k]) : 0);
        for (std::size_t k = 0; k < 4; ++k)
            text += i + k <= bytes.size() ? kDigits[group >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

ToneMap toneFor(const Picture& picture) {
    return toneMap(middleGreyOf(picture.metered).value_or(kUnmeasuredGrey), ToneStyle::agx);
}

std::string pictureUri(const Picture& picture, const ToneMap& tone) {
    std::vector<Rgb> shown(picture.colours);
    for (Rgb& colour : shown) colour = tone(colour);
    return pngUri(picture.width, picture.height, displayBytes(shown, picture.width));
}

std::string differenceUri(const Plane& jnd) {
    std::vector<std::uint8_t> pixels;
    pixels.reserve(3 * jnd.values.size());
    for (float value : jnd.values)
        for (std::uint8_t channel : differenceColour(value)) pixels.push_back(channel);
    return pngUri(jnd.width, jnd.height, pixels);
}

std::string differenceLegend() {
    std::string svg =
        "<svg xmlns='http://www.w3.org/2000/svg' width='380' height='40' viewBox='0 0 380 40' "
        "font-family='sans-serif' font-size='12'><defs><linearGradient id='jnd'>";
    const auto out = std::back_inserter(svg);
    for (std::size_t i = 0; i < kScale.size(); ++i)
        fmt::format_to(out, "<stop offset='{:.3f}' stop-color='#{:02x}{:02x}{:02x}'/>",
                       double(i) / double(kScale.size() - 1), kScale[i][0], kScale[i][1],
                       kScale[i][2]);
    svg += "</linearGradient></defs><rect x='20' y='2' width='300' height='14' "
           "fill='url(#jnd)' stroke='#888'/>";
    for (double jnd = kLeast; jnd <= kMost; jnd *= 2)
        fmt::format_to(out, "<text x='{:.0f}' y='32' text-anchor='middle'>{}</text>",
                       20 + 300 * std::log(jnd / kLeast) / std::log(kMost / kLeast), jnd);
    return svg + "<text x='332' y='32'>JND</text></svg>\n";
}

} // namespace penumbra
