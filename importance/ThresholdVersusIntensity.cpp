#include "importance/ThresholdVersusIntensity.h"

#include <cassert>
#include <cmath>

namespace penumbra {

double thresholdVersusIntensity(double adaptation) {
    assert(adaptation > 0);
    const double l = std::log10(adaptation);
    double threshold = 0; // log10
    if (l < -3.94)
        threshold = -2.86;
    else if (l < -1.44)
        threshold = std::pow(0.405 * l + 1.6, 2.18) - 2.86;
    else if (l < -0.0184)
        threshold = l - 0.395;
    else if (l < 1.9)
        threshold = std::pow(0.249 * l + 0.65, 2.7) - 0.72;
    else
        threshold = l - 1.255;
    return std::pow(10.0, threshold);
}

} // namespace penumbra
