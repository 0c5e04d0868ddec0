#include "io/image/AutoExposure.h"

#include <algorithm>
#include <cmath>

namespace penumbra {

void AutoExposure::measure(std::span<const float> luminances) {
    const std::optional<float> grey = middleGreyOf(luminances);
    if (!grey) return;
    const double measured = std::log2(double(*grey));
    if (!target_) current_ = measured;
    target_ = measured;
}

void AutoExposure::advance(double seconds, bool held) {
    if (!target_ || held || fixed_) return;
    const double tau = *target_ > current_ ? kBrighterSeconds : kDarkerSeconds;
    current_ = *target_ + (current_ - *target_) * std::exp(-std::max(0.0, seconds) / tau);
}

float AutoExposure::uncompensated() const {
    return fixed_ ? *fixed_ : float(std::exp2(current_));
}

float AutoExposure::middleGrey() const {
    return uncompensated() * std::exp2(-compensation_);
}

void AutoExposure::fix(std::optional<float> middleGrey) {
    if (fixed_ && !middleGrey) current_ = std::log2(double(*fixed_));
    fixed_ = middleGrey;
}

bool AutoExposure::settled() const {
    return fixed_ || !target_ || std::abs(current_ - *target_) < 0.01;
}

} // namespace penumbra
