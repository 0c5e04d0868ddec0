#include "io/image/Exposure.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace penumbra {

namespace {

/// Logarithms of the luminances that have one, ascending, the extremes cut off.
std::vector<double> sortedLogarithms(std::span<const float> luminances) {
    std::vector<double> logs;
    logs.reserve(luminances.size());
    for (const float y : luminances)
        if (y > 0 && std::isfinite(y)) logs.push_back(std::log2(double(y)));
    std::ranges::sort(logs);
    const std::ptrdiff_t cut = std::ptrdiff_t(logs.size()) / 100;
    return {logs.begin() + cut, logs.end() - cut};
}

} // namespace

std::optional<float> middleGreyOf(std::span<const float> luminances) {
    const std::vector<double> logs = sortedLogarithms(luminances);
    if (logs.empty()) return std::nullopt;
    double sum = 0;
    for (double log : logs) sum += log;
    const double mean = sum / double(logs.size());
    const double range = logs.back() - logs.front();
    // -1 for a view that is all dark but for little, 1 for one that is all bright
    const double lean = range > 0 ? (2 * mean - logs.front() - logs.back()) / range : 0;
    constexpr double kMostStops = 100; // so that pictures of any light stay within float
    return float(std::exp2(std::clamp(mean - 2 * lean, -kMostStops, kMostStops)));
}

double exposureValueOf(float middleGrey) {
    return std::log2(8 * double(middleGrey));
}

float middleGreyAt(double exposureValue) {
    return float(std::exp2(exposureValue) / 8);
}

} // namespace penumbra
