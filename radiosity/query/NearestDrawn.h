// The drawn surface near a point.
#pragma once

#include "radiosity/mesh/PatchSet.h"
#include "radiosity/query/DrawnSurface.h"

#include <glm/glm.hpp>

namespace penumbra {

/// The point of the drawn surface, as it is now, that lies nearest to another point. Of surfaces
/// that lie back to back or on each other it is the one that is lit and shows its front to the
/// point.
///
/// Goes through every element: meant for single questions.
///
/// \param point [m, world]
/// \param reach how far away it may be [m]
/// \return      its `distance` is in metres; not met() if nothing is within reach
DrawnHit nearestDrawn(const PatchSet& patches, glm::vec3 point, float reach);

/// Where in the world a hit is [m].
glm::vec3 positionOf(const PatchSet& patches, const DrawnHit& hit);
/// Which way the surface faces there: unit, interpolated as it is drawn.
glm::vec3 normalOf(const PatchSet& patches, const DrawnHit& hit);

} // namespace penumbra
