// How near something is to the object being moved.
#pragma once

#include "base/Bounds.h"

namespace penumbra {

/// Distance between the nearest points of two boxes [m]; 0 if they overlap.
double distanceBetween(const Bounds& a, const Bounds& b);

/// Who moves an object watches it and what is around it: work beside it counts up to twice as much
/// as far away,
///
///     1 + exp(-distance / 1 m)
///
/// A convention of ours, deliberately weak: what is near the object mostly comes first already,
/// because its light changes most.
/// \param distance [m], >= 0;  \return in (1, 2]
double proximityWeight(double distance);

} // namespace penumbra
