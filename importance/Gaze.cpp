#include "importance/Gaze.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace penumbra {

Gaze::Gaze(const Viewpoint& viewpoint, const GazeHints& hints)
    : first_(viewpoint.through(hints.point.value_or(glm::dvec2(0)))), second_(first_) {
    // Where an eye tracker reports the gaze, nothing is guessed.
    if (!hints.point && hints.dragged) second_ = viewpoint.towards(*hints.dragged);
}

double Gaze::eccentricity(glm::dvec3 direction) const {
    const double cosine = std::max(glm::dot(direction, first_), glm::dot(direction, second_));
    return glm::degrees(std::acos(std::clamp(cosine, -1.0, 1.0)));
}

double peripheralSensitivity(double eccentricity) {
    assert(eccentricity >= 0);
    return std::pow(10.0, -0.0331 * std::clamp(eccentricity - 10, 0.0, 50.0));
}

} // namespace penumbra
