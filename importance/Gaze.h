// What the viewer looks at, and how fast sight falls off around it.
#pragma once

#include "importance/Viewpoint.h"

#include <glm/glm.hpp>

#include <optional>

namespace penumbra {

/// What is known of where the viewer looks. Without an eye tracker that is a guess: at the middle
/// of the picture or at what is being dragged, whichever is nearer.
struct GazeHints {
    std::optional<glm::dvec2> point;   ///< that the application sets: [-1, 1], right and up
    std::optional<glm::dvec3> dragged; ///< middle of the object being moved [m, world]
};

/// One or two directions that the viewer may be looking in.
class Gaze {
public:
    explicit Gaze(const Viewpoint& viewpoint, const GazeHints& hints = {});

    /// Angle between a direction from the eye and the nearest of those [degrees], 0 to 180.
    /// \param direction unit
    double eccentricity(glm::dvec3 direction) const;

private:
    glm::dvec3 first_, second_; ///< unit
};

/// Sensitivity to changes in the periphery, relative to the centre of gaze: 1 within 10 degrees,
/// since a guessed gaze is no better than that, and from there as flicker detection falls off,
///
///     10^(-0.0331 (e - 10))
///
/// and beyond 60 degrees no further: what is there is seen when the head turns.
/// Acuity for what stands still falls off several times as fast; but light that changes is noticed
/// from the corner of the eye.
/// \param eccentricity e [degrees], >= 0;  \return in (0, 1]
///
/// Cai, Bozorgian, Ashraf, Wanat & Mantiuk, "elaTCSF", SIGGRAPH Asia 2024. The limits are ours.
double peripheralSensitivity(double eccentricity);

} // namespace penumbra
