#include "io/image/ToneCurve.h"

#include <algorithm>
#include <cmath>

namespace penumbra {

namespace {

// AgX: what is shown, in stops around middle grey, and the signal's exponent.
constexpr double kDarkest = -10, kBrightest = 6.5, kPower = 2.2;
constexpr double kSlope = 2.4, kBend = 1.5;
constexpr float kInset = 0.2f; // share of grey that is mixed in

/// A sigmoid through (x0, y0) with a slope, that comes to an end at `run` from x0 and `rise` from
/// y0:
///
///     h = slope (x - x0) / s,   y = y0 + s h / (1 + h^p)^(1/p),
///     s = ((slope run)^-p ((slope run / rise)^p - 1))^(-1/p)
///
/// with p = kBend how soft the bend is. Given for x >= x0; the curve below x0 is the same turned
/// round.
double bent(double distance, double run, double rise) {
    const double straight = kSlope * run;
    const double s =
        std::pow(std::pow(straight, -kBend) * (std::pow(straight / rise, kBend) - 1), -1 / kBend);
    const double h = kSlope * distance / s;
    return s * h / std::pow(1 + std::pow(h, kBend), 1 / kBend);
}

double agx(double value) {
    const double stops = std::log2(std::max(value, 1e-30) / kMiddleGrey);
    const double range = kBrightest - kDarkest;
    const double x = std::clamp((stops - kDarkest) / range, 0.0, 1.0);
    const double x0 = -kDarkest / range, y0 = std::pow(double(kMiddleGrey), 1 / kPower);
    const double y = x >= x0 ? y0 + bent(x - x0, 1 - x0, 1 - y0) : y0 - bent(x0 - x, x0, y0);
    return std::pow(std::clamp(y, 0.0, 1.0), kPower);
}

double narkowicz(double x) {
    return x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14);
}

double aces(double value) {
    // narkowicz(x) = 0.18 has the root x = 0.130171; beyond x = 7.2 the fit passes 1
    constexpr double kScale = 0.130171 / kMiddleGrey;
    return std::min(1.0, narkowicz(kScale * value));
}

} // namespace

ToneCurve::ToneCurve(ToneStyle style) : style_(style) {
    if (style != ToneStyle::agx) return;
    inset_ = glm::mat3(1 - kInset);
    for (int column = 0; column < 3; ++column) inset_[column] += glm::vec3(kInset / 3);
    outset_ = glm::inverse(inset_);
}

float ToneCurve::curve(float value) const {
    if (!(value > 0)) return 0;
    switch (style_) {
    case ToneStyle::agx:
        return float(agx(value));
    case ToneStyle::aces:
        return float(aces(value));
    case ToneStyle::srgb:
        break;
    }
    return std::min(value, 1.0f);
}

Rgb ToneCurve::shown(Rgb colour) const {
    const glm::vec3 in = inset_ * glm::max(glm::vec3(colour.r, colour.g, colour.b), 0.0f);
    const glm::vec3 out = outset_ * glm::vec3(curve(in.r), curve(in.g), curve(in.b));
    const glm::vec3 clamped = glm::clamp(out, 0.0f, 1.0f);
    return {clamped.r, clamped.g, clamped.b};
}

std::vector<float> ToneCurve::table() const {
    std::vector<float> values(kTableSize);
    for (int i = 0; i < kTableSize; ++i) {
        const float stops =
            kTableFirst + (kTableLast - kTableFirst) * float(i) / float(kTableSize - 1);
        values[std::size_t(i)] = curve(std::exp2(stops));
    }
    return values;
}

ToneMap toneMap(float middleGrey, ToneStyle style) {
    return [curve = ToneCurve(style), scale = kMiddleGrey / middleGrey](Rgb colour) {
        return curve.shown(colour * scale);
    };
}

} // namespace penumbra
