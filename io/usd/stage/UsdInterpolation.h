// Values between time samples.
#pragma once

#include "io/usd/layer/UsdLayer.h"

#include <span>

namespace penumbra {

/// The value of some samples at a time of their own layer, which is outside of the first and last
/// or between two of them. `held` is the sample to take; if `made` isn't empty, it is the value
/// instead.
struct UsdSampled {
    const UsdValue* held = nullptr;
    UsdValue made;
};

/// \param samples sorted by time, at least one
UsdSampled sampleUsd(std::span<const UsdTimeSample> samples, double time);

} // namespace penumbra
