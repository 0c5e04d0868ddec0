#include "importance/VisibleDifference.h"

#include "importance/ContrastSensitivity.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace penumbra {

namespace {

constexpr float kDarkest = 1e-4f;    ///< luminances below count as this [nit]
constexpr double kBandCentre = 0.25; ///< of the finest band [cycles per pixel]
constexpr double kCoarsest = 0.2;    ///< bands go down to about here [cycles per degree]
constexpr int kSmallest = 4;         ///< and to pictures this small [pixels]
/// Bands overlap, and a grating's share in its own is about 0.7: this makes one at its threshold
/// read as 1 JND.
constexpr float kBandGain = 1.4f;

/// Contrast sensitivity at one frequency, tabulated over the natural logarithm of luminance: the
/// formula costs four powers.
class SensitivityTable {
public:
    explicit SensitivityTable(double frequency) {
        for (int i = 0; i < kSize; ++i)
            table_[std::size_t(i)] =
                float(contrastSensitivity(frequency, std::exp(kFirst + double(i) / kPerUnit)));
    }
    float operator()(float logLuminance) const {
        const float at = (logLuminance - kFirst) * kPerUnit;
        const int i = std::clamp(int(at), 0, kSize - 2);
        const float t = std::clamp(at - float(i), 0.0f, 1.0f);
        return (1 - t) * table_[std::size_t(i)] + t * table_[std::size_t(i) + 1];
    }

private:
    static constexpr int kFirst = -10, kPerUnit = 6, kSize = 24 * kPerUnit + 1; // to e^14 nit
    std::array<float, kSize> table_;
};

Plane logarithm(const Plane& luminance) {
    Plane result(luminance.width, luminance.height);
    for (std::size_t i = 0; i < result.values.size(); ++i)
        result.values[i] = std::log(std::max(luminance.values[i], kDarkest));
    return result;
}

/// One band of a picture.
struct Band {
    Plane contrast; ///< of the logarithm of luminance; small ones are contrasts as usual
    Plane mean;     ///< logarithm of the luminance around
};

/// Splits off the finest band; `plane` becomes the rest, half as wide and as high.
Band takeBand(Plane& plane) {
    Plane coarse = reduced(plane);
    Band band{plane, expanded(coarse, plane.width, plane.height)};
    for (std::size_t i = 0; i < band.contrast.values.size(); ++i)
        band.contrast.values[i] -= band.mean.values[i];
    plane = std::move(coarse);
    return band;
}

/// Contrast that both pictures have, smoothed, since masking reaches across the zeros of a pattern.
Plane sharedContrast(const Plane& a, const Plane& b) {
    Plane shared(a.width, a.height);
    for (std::size_t i = 0; i < shared.values.size(); ++i)
        shared.values[i] = std::min(std::abs(a.values[i]), std::abs(b.values[i]));
    return smoothed(shared);
}

/// Visible difference, from the difference and the contrast that both share in units of the
/// threshold of either. Constants of the still achromatic channel of ColorVideoVDP 0.5.4.
float masked(float difference, float mask) {
    constexpr float kPower = 2.264f, kMaskPower = 1.303f, kMaskWeight = 0.877f;
    constexpr float kUncertainty = 0.160f; // 10^-0.795: a pattern is a worse mask than itself
    constexpr float kMost = 366.6f;        // 10^2.564: what is far above threshold appears alike
    const float excitation = std::pow(std::abs(difference), kPower);
    const float inhibition = 1 + kMaskWeight * std::pow(kUncertainty * mask, kMaskPower);
    const float response = excitation / inhibition;
    return std::pow(kMost * response / (kMost + response), 1 / kPower);
}

float fourthPower(float x) {
    return x * x * x * x;
}

/// Fourth powers of the visible differences in one band.
Plane bandDifference(const Band& test, const Band& reference, double frequency) {
    const SensitivityTable sensitivity(frequency);
    Plane result = sharedContrast(test.contrast, reference.contrast);
    for (std::size_t i = 0; i < result.values.size(); ++i) {
        const float mean = 0.5f * (test.mean.values[i] + reference.mean.values[i]);
        const float seen = kBandGain * sensitivity(mean);
        const float difference = test.contrast.values[i] - reference.contrast.values[i];
        result.values[i] = fourthPower(masked(seen * difference, seen * result.values[i]));
    }
    return result;
}

/// The same for what is left when all bands are split off.
Plane baseDifference(const Plane& test, const Plane& reference, double frequency) {
    const SensitivityTable sensitivity(frequency);
    Plane result(test.width, test.height);
    for (std::size_t i = 0; i < result.values.size(); ++i) {
        const float mean = 0.5f * (test.values[i] + reference.values[i]);
        const float difference = test.values[i] - reference.values[i];
        result.values[i] = fourthPower(masked(sensitivity(mean) * difference, 0));
    }
    return result;
}

} // namespace

Plane visibleDifference(const Plane& test, const Plane& reference, double pixelsPerDegree) {
    assert(test.width == reference.width && test.height == reference.height);
    assert(test.width > 0 && test.height > 0 && pixelsPerDegree > 0);
    Plane fineTest = logarithm(test), fineReference = logarithm(reference);
    std::vector<Plane> bands;
    double frequency = kBandCentre * pixelsPerDegree;
    while (frequency > kCoarsest && std::min(fineTest.width, fineTest.height) >= 2 * kSmallest) {
        const Band a = takeBand(fineTest), b = takeBand(fineReference);
        bands.push_back(bandDifference(a, b, frequency));
        frequency /= 2;
    }
    Plane sum = baseDifference(fineTest, fineReference, frequency);
    for (; !bands.empty(); bands.pop_back()) {
        Plane finer = expanded(sum, bands.back().width, bands.back().height);
        for (std::size_t i = 0; i < finer.values.size(); ++i)
            finer.values[i] += bands.back().values[i];
        sum = std::move(finer);
    }
    for (float& value : sum.values) value = std::sqrt(std::sqrt(value));
    return sum;
}

DifferenceSummary summarise(const Plane& jnd) {
    DifferenceSummary summary;
    if (jnd.values.empty()) return summary;
    double cubes = 0;
    for (float value : jnd.values) {
        summary.mean += value;
        cubes += double(value) * value * value;
        summary.most = std::max<double>(summary.most, value);
        summary.visible += value > 1;
    }
    const auto count = double(jnd.values.size());
    summary.mean /= count;
    summary.cubicMean = std::cbrt(cubes / count);
    summary.visible /= count;
    std::vector<float> sorted = jnd.values;
    const std::size_t rank = sorted.size() * 99 / 100;
    std::nth_element(sorted.begin(), sorted.begin() + std::ptrdiff_t(rank), sorted.end());
    summary.p99 = sorted[rank];
    return summary;
}

} // namespace penumbra
