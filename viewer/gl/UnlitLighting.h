// Light to see things by until radiosity has come.
#pragma once

#include "base/Rgb.h"
#include "scenegraph/Objects.h"

#include <glm/glm.hpp>

#include <vector>

namespace penumbra {

/// A light as a point with a direction. At distance d, under angle a to its axis, it gives
///
///     E = intensity * shape(a) / (d^2 + area / pi),   shape = cos a in front, or 1 all round
///
/// which is right far away and does not blow up close by; nothing casts a shadow.
struct UnlitLight {
    glm::dvec3 position{}; ///< [m, world]
    glm::dvec3 axis{};     ///< unit, the way it emits; zero: all round
    Rgb intensity;         ///< along the axis [cd]
    float area = 0;        ///< emitting, as seen from afar [m^2]
};

struct UnlitLighting {
    static constexpr std::size_t kMostLights = 16;

    std::vector<UnlitLight> lights; ///< the strongest ones, at most kMostLights
    /// Mean illuminance of the scene if the flux of its lights spread evenly over its bounding box
    /// [lux]: half of it comes from all around, and again as much from the headlight, head on.
    Rgb ambient;
};

/// Lights and emissive meshes of a scene as it is. Without any:
/// fallbackLight().
UnlitLighting unlitLighting(const PlacedScene& scene);

} // namespace penumbra
