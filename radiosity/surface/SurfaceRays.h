// What of a surface stops rays.
#pragma once

#include "radiosity/rays/RayMesh.h"
#include "radiosity/surface/SurfaceMesh.h"
#include "radiosity/surface/Tessellation.h"

#include <cstdint>
#include <vector>

namespace penumbra {

/// What a triangle for rays is of.
struct RaySource {
    static constexpr std::uint32_t kAll = 0xffffffffu;
    std::uint32_t firstCell = 0, cellCount = 1; ///< of the tessellation: their facets lie on it
    std::uint32_t facet = kAll;                 ///< which of the only cell's it is, or kAll
    bool turned = false;                        ///< its front is the surface's back
};

/// Adds the triangles of a surface to those of its object: flat faces block rays as the triangles
/// of their cells, curved ones as their elements.
/// \param mesh, tessellation of it, in the object's stretched frame [m]
/// \return where they come from, one by one
std::vector<RaySource> addRays(const SurfaceMesh& mesh, const Tessellation& tessellation,
                               RayMesh& rays);

} // namespace penumbra
