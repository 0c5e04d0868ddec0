// Which mesh or light does a ray meet first.
#pragma once

#include "scenegraph/ObjectId.h"
#include "scenegraph/Objects.h"

#include <glm/glm.hpp>

#include <optional>
#include <string>

namespace penumbra {

/// What a ray met.
struct Pick {
    ObjectId object;
    std::string path;     ///< of the mesh or light
    float distance = 0;   ///< along the ray [m]
    glm::vec3 position{}; ///< world space [m]
};

/// The nearest polygon (or light shape) in front of `origin` along `direction`. Subdivision
/// surfaces are met as their cages. Meshes are rejected by their bounds first; made for a click,
/// not for light. \param direction need not be unit; must not be zero
std::optional<Pick> pick(const PlacedScene& scene, glm::vec3 origin, glm::vec3 direction);

} // namespace penumbra
