// Why it is dark here, asked while walking.
#pragma once

#include "radiosity/query/LightAccount.h"
#include "radiosity/query/SceneRays.h"
#include "scenegraph/Objects.h"

#include <glm/glm.hpp>

#include <vector>

namespace penumbra {

/// The direct light of a point of a surface, light by light, evaluated there: closed-form form
/// factors times 64 shadow rays a light. What blocks a ray is charged with its share. Who loses
/// most comes first, then who gives most. Object ids are those of `scene`.
///
/// As accountForLight(), which reads the same off a solution, but of the scene as it is: good
/// before anything is solved, and while things are dragged.
///
/// \param position,normal [m, world]; unit, towards the lit side
std::vector<EmitterAccount> probeLight(const PlacedScene& scene, const SceneRays& rays,
                                       glm::dvec3 position, glm::dvec3 normal);

} // namespace penumbra
