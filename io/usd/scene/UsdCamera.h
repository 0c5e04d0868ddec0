// UsdGeomCamera.
#pragma once

#include "io/usd/layer/UsdDiagnostic.h"
#include "io/usd/stage/UsdAttributes.h"
#include "scenegraph/Camera.h"

namespace penumbra {

/// The lens of a Camera prim; the standard one, with a warning, if its focal length or an aperture
/// is not positive.
Lens usdLens(const UsdAttributes& camera, Diagnostics& diagnostics);

} // namespace penumbra
