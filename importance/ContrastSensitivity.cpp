#include "importance/ContrastSensitivity.h"

#include <cassert>
#include <cmath>

namespace penumbra {

double contrastSensitivity(double frequency, double luminance) {
    assert(frequency > 0 && luminance > 0);
    const double peak = 378.2 * std::pow(1 + 37.21 / luminance, -0.364);
    const double best = 2.942 * std::pow(1 + 27.38 / luminance, -0.197);
    const double x = std::log2(frequency / best);
    const double drop = x < 0 ? 0.200 * std::pow(-x, 1.269) : 0.1203 * x * x;
    return peak * std::pow(10.0, -drop);
}

double peakContrastSensitivity(double luminance) {
    assert(luminance > 0);
    return 364.2 * std::pow(1 + 29.994 / luminance, -0.394);
}

} // namespace penumbra
