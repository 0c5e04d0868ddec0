// What is known at the nodes of patches, in between.
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

/// Value at a vertex: in its patch or, on a dense mesh, between the middles of the patches around
/// it, as far as these are not covered. \pre it lies in a patch
template <class Value, class ValueAt>
Value interpolate(const PatchSet& set, const PatchCoordinate& at, const ValueAt& valueAt) {
    const Patch& patch = set.patches[at.patch];
    if (at.blend == PatchCoordinate::kNone) return interpolate<Value>(patch, at.s, at.t, valueAt);
    const NodeBlend& blend = set.blends[at.blend];
    Value sum = 0.0 * valueAt(patch.centreNode);
    double weights = 0;
    for (std::size_t k = 0; k < blend.patches.size() && blend.weights[k] > 0; ++k) {
        const std::uint32_t p = blend.patches[k];
        if (!set.parts.used.empty() && !set.parts.used[p]) continue;
        sum = sum + double(blend.weights[k]) * valueAt(set.patches[p].centreNode);
        weights += double(blend.weights[k]);
    }
    return weights > 0 ? (1 / weights) * sum : valueAt(patch.centreNode);
}

/// The same from a list. \param nodeValues one value a node of the PatchSet
template <class Value>
Value interpolateNodes(const PatchSet& set, const PatchCoordinate& at,
                       std::span<const Value> nodeValues) {
    return interpolate<Value>(set, at, [&](std::uint32_t n) { return nodeValues[n]; });
}

} // namespace penumbra
