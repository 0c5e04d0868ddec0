#include "io/image/PngWriter.h"

#include "io/image/AtomicFile.h"
#include "io/image/PngEncoder.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

namespace penumbra {

namespace {

constexpr float kMiddleGrey = 0.18f;

/// sRGB's transfer function, IEC 61966-2-1.
double srgbEncoded(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

/// Interleaved gradient noise, in [0, 1): within each 3x3 pixels the values are well spread.
double gradientNoise(int x, int y) {
    const double inner = 0.06711056 * x + 0.00583715 * y;
    const double outer = 52.9829189 * (inner - std::floor(inner));
    return outer - std::floor(outer);
}

/// Logarithms of the luminances that have one, ascending, the extremes cut off.
std::vector<float> sortedLogarithms(std::span<const float> luminances) {
    std::vector<float> logs;
    logs.reserve(luminances.size());
    for (const float y : luminances)
        if (y > 0 && std::isfinite(y)) logs.push_back(std::log2(y));
    std::sort(logs.begin(), logs.end());
    const std::ptrdiff_t cut = std::ptrdiff_t(logs.size()) / 100;
    return {logs.begin() + cut, logs.end() - cut};
}

bool anyLight(const std::vector<float>& luminances) {
    return std::any_of(luminances.begin(), luminances.end(),
                       [](float y) { return y > 0 && std::isfinite(y); });
}

/// The luminances that count: of reflected light, or else of all.
std::vector<float> luminancesOf(const FrameLayers& frame) {
    std::vector<float> luminances(frame.pixelCount());
    for (std::size_t i = 0; i < luminances.size(); ++i)
        luminances[i] = luminance(frame.direct[i] + frame.indirect[i]);
    if (anyLight(luminances)) return luminances;
    for (std::size_t i = 0; i < luminances.size(); ++i) luminances[i] = luminance(frame.beauty[i]);
    return luminances;
}

} // namespace

Exposure chooseExposure(std::span<const float> luminances) {
    const std::vector<float> logs = sortedLogarithms(luminances);
    Exposure exposure;
    if (logs.empty()) return exposure;
    double sum = 0;
    for (float log : logs) sum += log;
    const double mean = sum / double(logs.size());
    const double range = double(logs.back()) - logs.front();
    // -1 for a picture that is all dark but for little, 1 for one that is all bright
    const double lean = range > 0 ? (2 * mean - logs.front() - logs.back()) / range : 0;
    exposure.middleGrey = float(std::exp2(mean) * std::pow(4.0, -lean));
    // Below this the operator would no longer press highlights together but stretch them.
    exposure.white = std::max(std::exp2(logs.back()), exposure.middleGrey / kMiddleGrey);
    return exposure;
}

Exposure chooseExposure(const FrameLayers& frame, const ToneOptions& options) {
    assert(!options.middleGrey || *options.middleGrey > 0);
    Exposure exposure = chooseExposure(luminancesOf(frame));
    if (options.middleGrey) exposure.middleGrey = *options.middleGrey;
    if (options.white) exposure.white = *options.white;
    exposure.white = std::max(exposure.white, exposure.middleGrey / kMiddleGrey);
    return exposure;
}

Rgb toneMapped(Rgb colour, const Exposure& exposure) {
    colour = {std::max(colour.r, 0.0f), std::max(colour.g, 0.0f), std::max(colour.b, 0.0f)};
    const float y = luminance(colour);
    if (!(y > 0) || !std::isfinite(y)) return {};
    const float scale = kMiddleGrey / exposure.middleGrey;
    const float level = y * scale;
    const float white = exposure.white * scale;
    const float shown = std::min(1.0f, level * (1 + level / (white * white)) / (1 + level));
    const Rgb scaled = colour * (shown / y);
    const float most = maxChannel(scaled);
    if (most <= 1) return scaled;
    const float keep = (1 - shown) / (most - shown); // most > 1 >= shown
    return Rgb(shown) + (scaled - Rgb(shown)) * keep;
}

std::vector<std::uint8_t> displayBytes(std::span<const Rgb> shown, int width) {
    assert(width > 0 && shown.size() % std::size_t(width) == 0);
    std::vector<std::uint8_t> bytes;
    bytes.reserve(3 * shown.size());
    for (std::size_t i = 0; i < shown.size(); ++i) {
        // not quite 0 to 1, so that rounding errors never show in black and in white
        const double noise = 0.0005 + 0.999 * gradientNoise(int(i % std::size_t(width)),
                                                            int(i / std::size_t(width)));
        for (float channel : {shown[i].r, shown[i].g, shown[i].b}) {
            const double level = 255 * srgbEncoded(std::clamp(channel, 0.0f, 1.0f));
            bytes.push_back(std::uint8_t(std::min(255.0, std::floor(level + noise))));
        }
    }
    return bytes;
}

std::vector<std::uint8_t> toneMappedBytes(const FrameLayers& frame, const Exposure& exposure) {
    std::vector<Rgb> shown(frame.beauty);
    for (Rgb& colour : shown) colour = toneMapped(colour, exposure);
    return displayBytes(shown, std::max(1, frame.width));
}

void writePng(const std::string& path, const FrameLayers& frame, const ToneOptions& options) {
    writePngBytes(path, frame.width, frame.height,
                  toneMappedBytes(frame, chooseExposure(frame, options)));
}

void writePngBytes(const std::string& path, int width, int height,
                   std::span<const std::uint8_t> pixels) {
    const std::vector<std::byte> file = encodePng(width, height, pixels);
    writeFileAtomically(path, std::span<const std::byte>(file));
}

} // namespace penumbra
