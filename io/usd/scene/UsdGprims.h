// Cube, Sphere, Cylinder, Cone, Capsule, Plane: as polygons.
#pragma once

#include "io/usd/scene/UsdPolygons.h"

#include <string>

namespace penumbra {

/// Whether makeUsdGprim() knows the type.
bool isUsdGprim(std::string_view typeName);

/// A gprim as polygons, counter-clockwise seen from outside, its vertices on the true surface:
///
/// | type | faces |
/// |---|---|
/// | Cube | 6 quadrilaterals |
/// | Sphere | 16 rings of 32 (the two at the poles of triangles): 512 |
/// | Cylinder | 32 sides and two caps of 32 corners |
/// | Cone | 32 triangles and a base of 32 corners |
/// | Capsule | 32 sides and two half spheres of 8 rings of 32: 544 |
/// | Plane | 1, doubleSided unless the file says otherwise |
///
/// Sizes that are not positive give faces without area, hence, with a warning, nothing.
UsdPolygons makeUsdGprim(const UsdAttributes& prim, Diagnostics& diagnostics);

/// What makes a gprim's mesh besides its material: gprims of the same key have the same. Empty for
/// those that have primvars.
std::string usdGprimKey(const UsdAttributes& prim);

} // namespace penumbra
