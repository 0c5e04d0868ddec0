// Triangles that are halves of one flat quadrilateral.
#pragma once

#include "radiosity/surface/SurfaceMesh.h"

namespace penumbra {

/// Joins triangles of a plain mesh in pairs: those that lie in one plane, have one material and
/// share the longest edge of both, along which normals and texture coordinates run on, if the
/// quadrilateral has sides about as long as those opposite. Most files hold nothing but triangles;
/// a quadrilateral is cut into a regular grid, and a triangle is not.
///
/// Which are joined is a function of the two triangles, whatever else there is.
void joinTriangles(SurfaceMesh& mesh);

} // namespace penumbra
