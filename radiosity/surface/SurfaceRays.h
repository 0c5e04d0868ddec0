// What of a surface stops rays.
#pragma once

#include "radiosity/rays/RayMesh.h"
#include "radiosity/surface/SurfaceMesh.h"
#include "radiosity/surface/Tessellation.h"

namespace penumbra {

/// Adds the triangles of a surface to those of its object: flat faces block rays as the triangles
/// of their cells, curved ones as their elements.
/// \param mesh, tessellation of it, in the object's stretched frame [m]
void addRays(const SurfaceMesh& mesh, const Tessellation& tessellation, RayMesh& rays);

} // namespace penumbra
