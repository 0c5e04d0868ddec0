#include "comparison/ErrorCurve.h"

#include <algorithm>
#include <cassert>

namespace penumbra {

namespace {

template <class Of>
std::vector<CurvePoint> errorOver(std::span<const ErrorSample> samples, Of x) {
    std::vector<CurvePoint> curve;
    curve.reserve(samples.size());
    for (const ErrorSample& sample : samples) curve.push_back({x(sample), sample.error.mean});
    return curve;
}

} // namespace

std::vector<CurvePoint> errorOverWork(std::span<const ErrorSample> samples) {
    return errorOver(samples, [](const ErrorSample& sample) { return sample.work; });
}

std::vector<CurvePoint> errorOverTime(std::span<const ErrorSample> samples) {
    return errorOver(samples, [](const ErrorSample& sample) { return sample.seconds; });
}

double valueAt(std::span<const CurvePoint> curve, double x) {
    assert(!curve.empty());
    const auto after = std::upper_bound(curve.begin(), curve.end(), x,
                                        [](double at, const CurvePoint& p) { return at < p.x; });
    return after == curve.begin() ? after->y : std::prev(after)->y;
}

double normalisedArea(std::span<const CurvePoint> curve, double last) {
    assert(!curve.empty());
    const double first = curve.front().y;
    if (!(first > 0) || !(last > 0)) return 0;
    double area = 0;
    for (std::size_t i = 0; i < curve.size(); ++i) {
        const double from = i == 0 ? 0 : std::clamp(curve[i].x, 0.0, last);
        const double to = i + 1 < curve.size() ? std::clamp(curve[i + 1].x, 0.0, last) : last;
        area += std::max(0.0, to - from) * curve[i].y;
    }
    return area / (first * last);
}

std::optional<double> whenBelow(std::span<const CurvePoint> curve, double share) {
    if (curve.empty()) return {};
    const double limit = share * curve.front().y;
    if (curve.back().y > limit) return {};
    std::size_t i = curve.size();
    while (i > 0 && curve[i - 1].y <= limit) --i;
    return i == 0 ? curve.front().x : curve[i].x;
}

std::vector<CurvePoint> meanOf(std::span<const std::vector<CurvePoint>> curves) {
    std::vector<double> places;
    for (const auto& curve : curves)
        for (const CurvePoint& point : curve) places.push_back(point.x);
    std::sort(places.begin(), places.end());
    places.erase(std::unique(places.begin(), places.end()), places.end());
    std::vector<CurvePoint> mean;
    for (double x : places) {
        CurvePoint point{x, 0};
        for (const auto& curve : curves) point.y += valueAt(curve, x) / double(curves.size());
        mean.push_back(point);
    }
    return mean;
}

} // namespace penumbra
