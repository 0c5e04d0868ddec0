// The normals of a surface that a mesh of polygons stands for, where nobody gave any.
#pragma once

#include "scenegraph/Mesh.h"

#include <vector>

namespace penumbra {

/// Faces that meet at less than this belong to one smooth surface; a crease lies between others.
/// [degrees]
constexpr double kCreaseAngle = 30;

/// One normal a corner, as in MeshData::normals: the mean of the faces around its point whose
/// normals are within kCreaseAngle of its own face's, each by its area and by its angle at the
/// point (cf. Thuermer & Wuethrich 1998, and Max 1999), so that a large wall stays flat beside a
/// narrow bevel. Points at exactly one place are one point. Zero where all these faces lie in one
/// plane, and where more than 500 corners meet. Empty if that is everywhere: a box stays as it is.
/// \pre data.scheme is none; no face is without area
std::vector<glm::vec3> creaseNormals(const MeshData& data);

} // namespace penumbra
