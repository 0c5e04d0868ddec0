// The normals that a file gives the surface of a mesh.
#pragma once

#include "io/usd/scene/UsdPolygons.h"

#include <vector>

namespace penumbra {

/// `primvars:normals`, else `normals`, of any interpolation, indexed or not: one a corner, in the
/// file's order of faces and corners, unit; a zero where the file has none that can be used. Empty
/// if there are none, if the mesh is subdivided (its surface has normals of its own), or, with a
/// warning, if their number does not fit.
std::vector<glm::vec3> readUsdNormals(const UsdAttributes& mesh, const UsdPolygons& polygons,
                                      Diagnostics& diagnostics);

} // namespace penumbra
