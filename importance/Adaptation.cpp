#include "importance/Adaptation.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace penumbra {

namespace {

constexpr double kDarkest = 1e-4;    ///< [nit]
constexpr double kScattered = 0.005; ///< share of the picture's light, everywhere

} // namespace

double meanAdaptation(std::span<const float> luminances) {
    if (luminances.empty()) return kDarkest;
    double sum = 0;
    for (float luminance : luminances) sum += std::log(std::max<double>(luminance, kDarkest));
    return std::exp(sum / double(luminances.size()));
}

double localAdaptation(double surface, double picture) {
    return std::max(kDarkest, surface + kScattered * picture);
}

void Adaptation::adapt(double luminance, double seconds) {
    assert(luminance > 0 && seconds >= 0);
    const double rods = 0.04 / (0.04 + luminance);
    const double tau = 0.4 * rods + 0.1 * (1 - rods); // [s]
    luminance_ += (luminance - luminance_) * -std::expm1(-seconds / tau);
}

} // namespace penumbra
