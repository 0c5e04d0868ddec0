// What is known at a patch's nodes, in between.
#pragma once

#include "radiosity/mesh/PatchSet.h"

#include <span>

namespace penumbra {

/// Value at a point of a patch from the values at its nodes: bilinear between the corners, plus a
/// bubble that lifts the middle to what is known there and leaves the edges, which neighbours
/// share, alone. A patch without corner nodes has the value of its middle all over.
/// \param valueAt value at a node of the PatchSet, by index
template <class Value, class ValueAt>
Value interpolate(const Patch& patch, float s, float t, const ValueAt& valueAt) {
    const Value middle = valueAt(patch.centreNode);
    if (!patch.hasCornerNodes) return middle;
    const double w[4] = {double(1 - s) * (1 - t), double(s) * (1 - t), double(s) * t,
                         double(1 - s) * t};
    const double bubble = 16.0 * w[0] * w[2];
    Value value = bubble * middle;
    for (std::size_t k = 0; k < 4; ++k)
        value = value + (w[k] - 0.25 * bubble) * valueAt(patch.cornerNodes[k]);
    return value;
}

/// The same from a list. \param nodeValues one value a node of the PatchSet
template <class Value>
Value interpolateNodes(const Patch& patch, float s, float t, std::span<const Value> nodeValues) {
    return interpolate<Value>(patch, s, t, [&](std::uint32_t n) { return nodeValues[n]; });
}

} // namespace penumbra
