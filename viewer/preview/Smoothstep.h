// How far a fade has come.
#pragma once

#include <algorithm>

namespace penumbra {

/// Share w of the way that is done: w = s^2 (3 - 2 s), s = (time - start) / seconds, in [0, 1].
inline float smoothstep(double time, double start, double seconds) {
    const double s = seconds > 0 ? std::clamp((time - start) / seconds, 0.0, 1.0) : 1.0;
    return float(s * s * (3 - 2 * s));
}

} // namespace penumbra
