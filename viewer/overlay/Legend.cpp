#include "viewer/overlay/Legend.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace penumbra {

float LogScale::at(double value) const {
    const double from = std::log10(first), to = std::log10(last);
    const double place = (std::log10(std::max(value, 1e-300)) - from) / (to - from);
    return float(std::clamp(place, 0.0, 1.0));
}

std::vector<Legend::Tick> ticksOf(const LogScale& scale) {
    const auto [least, most] = std::minmax(scale.first, scale.last);
    std::vector<Legend::Tick> ticks;
    for (int power = int(std::ceil(std::log10(least) - 1e-6));
         power <= int(std::floor(std::log10(most) + 1e-6)); ++power) {
        char label[32];
        std::snprintf(label, sizeof label, "%g", std::pow(10.0, power));
        ticks.push_back({scale.at(std::pow(10.0, power)), label});
    }
    return ticks;
}

} // namespace penumbra
