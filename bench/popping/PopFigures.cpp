#include "PopFigures.h"

#include "importance/ContrastSensitivity.h"

#include <algorithm>
#include <cmath>

namespace penumbra {

namespace {

constexpr double kDarkest = 0.1, kBrightest = 100; // of a display [nit]

double displayed(float luminance, double toDisplay) {
    return std::clamp(double(luminance) * toDisplay, kDarkest, kBrightest);
}

double percentileOf(std::vector<double>& values, double p) {
    if (values.empty()) return 0;
    const auto at = values.begin() + std::ptrdiff_t(p * double(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

} // namespace

double visibleStep(double luminance) {
    const double peak = 5273.1 * std::pow(1 + 49726 / luminance, -0.439);
    const double best = 1.618 * std::pow(1 + 2.06 / luminance, -0.115);
    const double x = std::log2(1.6 / best);
    const double lost = x < 0 ? 0.059 * std::pow(-x, 1.466) : 0.0848 * x * x;
    return 1 / (0.417 * peak * std::pow(10, -lost));
}

namespace {

/// Of one pixel [nit on the display].
class ErrorOverTime {
public:
    ErrorOverTime(std::span<const FramePair> frames, double toDisplay, std::size_t pixel)
        : frames_(frames), toDisplay_(toDisplay), pixel_(pixel) {}
    double operator()(std::size_t t) const {
        return toDisplay_ * (double(frames_[t].shown[pixel_]) - double(frames_[t].exact[pixel_]));
    }
    /// Luminance that is just seen to come or go.
    double unit(std::size_t t) const {
        const double level = displayed(frames_[t].exact[pixel_], toDisplay_);
        return level * visibleStep(level);
    }

private:
    std::span<const FramePair> frames_;
    double toDisplay_;
    std::size_t pixel_;
};

} // namespace

PopFigures popFigures(std::span<const FramePair> frames, double toDisplay) {
    if (frames.size() < 2) return {};
    const std::size_t pixels = frames.front().shown.size();
    std::vector<double> largest(pixels), excess(pixels);
    for (std::size_t p = 0; p < pixels; ++p) {
        const ErrorOverTime error(frames, toDisplay, p);
        double sum = 0, unit = 1;
        for (std::size_t t = 1; t < frames.size(); ++t) {
            unit = error.unit(t);
            const double step = std::abs(error(t) - error(t - 1));
            largest[p] = std::max(largest[p], step / unit);
            sum += step;
        }
        excess[p] = (sum - std::abs(error(frames.size() - 1) - error(0))) / unit;
    }
    PopFigures figures;
    figures.most = *std::max_element(largest.begin(), largest.end());
    figures.share =
        double(std::count_if(largest.begin(), largest.end(), [](double u) { return u > 1; })) /
        double(pixels);
    figures.p999 = percentileOf(largest, 0.999);
    figures.flicker = percentileOf(excess, 0.999);
    return figures;
}

std::vector<PixelStep> worstSteps(std::span<const FramePair> frames, double toDisplay,
                                  std::size_t most) {
    if (frames.size() < 2) return {};
    std::vector<PixelStep> steps(frames.front().shown.size());
    for (std::size_t p = 0; p < steps.size(); ++p) {
        const ErrorOverTime error(frames, toDisplay, p);
        steps[p].pixel = p;
        for (std::size_t t = 1; t < frames.size(); ++t) {
            const double size = std::abs(error(t) - error(t - 1)) / error.unit(t);
            if (size > steps[p].size) steps[p] = {p, t, size};
        }
    }
    most = std::min(most, steps.size());
    std::partial_sort(steps.begin(), steps.begin() + std::ptrdiff_t(most), steps.end(),
                      [](const PixelStep& a, const PixelStep& b) { return a.size > b.size; });
    steps.resize(most);
    return steps;
}

double visibleError(const FramePair& frame, double toDisplay, double p) {
    std::vector<double> errors;
    for (std::size_t i = 0; i < frame.shown.size(); ++i) {
        const double level = displayed(frame.exact[i], toDisplay);
        errors.push_back(toDisplay * std::abs(double(frame.shown[i]) - double(frame.exact[i])) /
                         level * peakContrastSensitivity(level));
    }
    return percentileOf(errors, p);
}

} // namespace penumbra
