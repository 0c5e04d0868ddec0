#include "io/image/PngWriter.h"

#include "base/Srgb.h"
#include "io/image/AtomicFile.h"
#include "io/image/PngEncoder.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

namespace penumbra {

namespace {

/// Interleaved gradient noise, in [0, 1): within each 3x3 pixels the values are well spread.
double gradientNoise(int x, int y) {
    const double inner = 0.06711056 * x + 0.00583715 * y;
    const double outer = 52.9829189 * (inner - std::floor(inner));
    return outer - std::floor(outer);
}

} // namespace

std::vector<std::uint8_t> displayBytes(std::span<const Rgb> shown, int width) {
    assert(width > 0 && shown.size() % std::size_t(width) == 0);
    std::vector<std::uint8_t> bytes;
    bytes.reserve(3 * shown.size());
    for (std::size_t i = 0; i < shown.size(); ++i) {
        // not quite 0 to 1, so that rounding errors never show in black and in white
        const double noise = 0.0005 + 0.999 * gradientNoise(int(i % std::size_t(width)),
                                                            int(i / std::size_t(width)));
        for (float channel : {shown[i].r, shown[i].g, shown[i].b}) {
            const double level = 255 * srgbFromLinear(double(std::clamp(channel, 0.0f, 1.0f)));
            bytes.push_back(std::uint8_t(std::min(255.0, std::floor(level + noise))));
        }
    }
    return bytes;
}

void writePng(const std::string& path, const FrameLayers& frame) {
    assert(frame.shown.size() == frame.pixelCount());
    writePngBytes(path, frame.width, frame.height, displayBytes(frame.shown, frame.width));
}

void writePngBytes(const std::string& path, int width, int height,
                   std::span<const std::uint8_t> pixels) {
    const std::vector<std::byte> file = encodePng(width, height, pixels);
    writeFileAtomically(path, std::span<const std::byte>(file));
}

} // namespace penumbra
