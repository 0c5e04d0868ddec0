// What leaves a sender of indirect light, and what of it arrives.
#pragma once

#include "radiosity/rows/Row.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace penumbra {

/// What leaves a sender, quarter by quarter [lm/m^2]; all the same for a patch.
using SenderLight = std::array<glm::dvec3, 4>;

/// Largest channel, whatever its sign.
inline double largest(glm::dvec3 v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

inline double largest(const SenderLight& light) {
    return std::max({largest(light[0]), largest(light[1]), largest(light[2]), largest(light[3])});
}

/// Calls visit(receiver, form factor times visibility, what that makes of `light`).
template <class Visit>
void forEachReceived(const RowBlock& block, const SenderLight& light, const Visit& visit) {
    if (!block.isParted()) {
        block.forEach([&](int r, float factor) { visit(r, factor, double(factor) * light[0]); });
        return;
    }
    // Sum over the quarters, put by the shares that the first one, two and three of them have.
    const glm::dvec3 steps[3] = {(light[0] - light[1]) / 255.0, (light[1] - light[2]) / 255.0,
                                 (light[2] - light[3]) / 255.0};
    block.forEachParted([&](int r, float factor, RowBlock::Split split) {
        visit(r, factor,
              double(factor) * (light[3] + double(split[0]) * steps[0] +
                                double(split[1]) * steps[1] + double(split[2]) * steps[2]));
    });
}

} // namespace penumbra
