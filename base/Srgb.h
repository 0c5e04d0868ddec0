// The transfer function of sRGB (IEC 61966-2-1), both ways.
#pragma once

#include <cmath>

namespace penumbra {

/// \param coded in [0, 1]
template <class T>
T linearFromSrgb(T coded) {
    return coded <= T(0.04045) ? coded / T(12.92) : std::pow((coded + T(0.055)) / T(1.055), T(2.4));
}

/// \param linear not negative
template <class T>
T srgbFromLinear(T linear) {
    return linear <= T(0.0031308) ? T(12.92) * linear
                                  : T(1.055) * std::pow(linear, 1 / T(2.4)) - T(0.055);
}

} // namespace penumbra
