// UsdGeomCamera.
#pragma once

#include "io/usd/layer/UsdDiagnostic.h"
#include "io/usd/stage/UsdAttributes.h"
#include "io/usd/stage/UsdSampleCheck.h"
#include "scenegraph/Camera.h"

namespace penumbra {

/// The lens of a Camera prim; the standard one, with a warning, if its focal length or an aperture
/// is not positive.
Lens usdLens(const UsdAttributes& camera, Diagnostics& diagnostics);
/// Warns of what can't be used at other times than that of the load.
void checkUsdLens(const UsdPrim& camera, UsdSampleCheck& check);

} // namespace penumbra
