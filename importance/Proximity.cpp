#include "importance/Proximity.h"

#include <cassert>
#include <cmath>

namespace penumbra {

double distanceBetween(const Bounds& a, const Bounds& b) {
    const glm::vec3 gap = glm::max(glm::max(a.lower - b.upper, b.lower - a.upper), glm::vec3(0));
    return glm::length(gap);
}

double proximityWeight(double distance) {
    assert(distance >= 0);
    return 1 + std::exp(-distance);
}

} // namespace penumbra
