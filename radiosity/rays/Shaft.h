// Regions that light crosses on its way between boxes.
#pragma once

#include "base/Bounds.h"

#include <glm/glm.hpp>

namespace penumbra {

/// Whether a box that moves linearly, box(t) = from + t * change, meets `target` at any t in
/// [0, last].
inline bool sweepMeets(const Bounds& from, glm::vec3 changeLower, glm::vec3 changeUpper, float last,
                       const Bounds& target) {
    float first = 0;
    const auto clip = [&](float at, float slope) { // keeps the t with at + t * slope <= 0
        if (slope > 0)
            last = std::min(last, -at / slope);
        else if (slope < 0)
            first = std::max(first, -at / slope);
        else if (at > 0)
            last = -1;
    };
    for (int axis = 0; axis < 3; ++axis) {
        clip(from.lower[axis] - target.upper[axis], changeLower[axis]);
        clip(target.lower[axis] - from.upper[axis], -changeUpper[axis]);
    }
    return first <= last;
}

/// Whether the shaft between two boxes, the union of the boxes (1 - t) a + t b for t in [0, 1],
/// meets a third: six linear inequalities in t. Conservative for what is inside of the boxes
/// ([Haines1994] bound the same region by planes).
inline bool shaftMeets(const Bounds& a, const Bounds& b, const Bounds& target) {
    return sweepMeets(a, b.lower - a.lower, b.upper - a.upper, 1.0f, target);
}

/// Whether rays that leave `from` in directions between `directionLower` and `directionUpper`
/// can meet `target`.
inline bool raysMeet(const Bounds& from, glm::vec3 directionLower, glm::vec3 directionUpper,
                     const Bounds& target) {
    return sweepMeets(from, directionLower, directionUpper, std::numeric_limits<float>::infinity(),
                      target);
}

/// `box` grown by `margin` on all sides [m].
inline Bounds grown(const Bounds& box, float margin) {
    if (box.empty()) return box;
    return {box.lower - glm::vec3(margin), box.upper + glm::vec3(margin)};
}

} // namespace penumbra
