// What is known at a patch's nodes, in between.
#pragma once

#include "radiosity/PatchSet.h"

#include <span>

namespace penumbra {

/// Value at a place in a patch from the values at its nodes: bilinear between the corners, plus a
/// bubble that lifts the middle to what is known there and leaves the edges, which neighbours
/// share, alone. A patch without corner nodes has the value of its middle all over. \param
/// nodeValues one value a node of the PatchSet
template <class Value>
Value interpolateNodes(const Patch& patch, float s, float t, std::span<const Value> nodeValues) {
    const Value middle = nodeValues[patch.centreNode];
    if (!patch.hasCornerNodes) return middle;
    const auto corner = [&](std::size_t k) { return nodeValues[patch.cornerNodes[k]]; };
    const double w[4] = {double(1 - s) * (1 - t), double(s) * (1 - t), double(s) * t,
                         double(1 - s) * t};
    const double bubble = 16.0 * w[0] * w[2];
    Value value = bubble * middle;
    for (std::size_t k = 0; k < 4; ++k) value = value + (w[k] - 0.25 * bubble) * corner(k);
    return value;
}

} // namespace penumbra
