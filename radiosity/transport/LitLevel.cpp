#include "radiosity/transport/LitLevel.h"

#include <algorithm>

namespace penumbra {

void LitLevel::add(double illuminance, double area) {
    if (illuminance > 0 && area > 0) lit_.emplace_back(illuminance, area);
}

double LitLevel::median() const {
    std::vector<std::pair<double, double>> sorted = lit_;
    std::sort(sorted.begin(), sorted.end());
    double whole = 0;
    for (const auto& [illuminance, area] : sorted) whole += area;
    double below = 0;
    for (const auto& [illuminance, area] : sorted)
        if ((below += area) >= whole / 2) return illuminance;
    return 0;
}

} // namespace penumbra
