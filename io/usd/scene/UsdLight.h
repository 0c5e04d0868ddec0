// UsdLux: what a light sends, and from where.
#pragma once

#include "base/Rgb.h"
#include "io/usd/layer/UsdDiagnostic.h"
#include "io/usd/stage/UsdAttributes.h"
#include "io/usd/stage/UsdSampleCheck.h"
#include "scenegraph/Node.h"

#include <glm/glm.hpp>

#include <string_view>
#include <vector>

namespace penumbra {

/// Linear Rec. 709 colour of a black body, scaled to luminance 1. Clamped to 1000 .. 10000 K.
///
/// From 2000 K up: Planckian locus after [Kang2002]; within 0.006 of OpenUSD 24.11. Below, where
/// Rec. 709 can't show the true colours, a parabola through what OpenUSD itself shows at 1000 and
/// 1500 K, so that a file looks the same in both.
Rgb blackbodyColour(double kelvin);

/// Luminance of a light [nit]:
///
///     L = color * blackbody(T) * intensity * 2^exposure * diffuse / sizeFactor
///
/// \param area  of the emitting surface in the world, in scene units squared: the size factor if
///              `inputs:normalize` is on
/// Warns of inputs that are ignored (shaping, textures, light linking, old names). Never negative
/// and always finite.
Rgb usdLightLuminance(const UsdAttributes& light, double area, Diagnostics& diagnostics);

/// Warns of what can't be used at other times than that of the load.
void checkUsdLight(const UsdPrim& light, UsdSampleCheck& check);

/// Its extents along its own axes [scene units], 1 where it has none; 0 for what is not positive.
glm::dvec3 usdLightSize(const UsdAttributes& light);
/// Names of those of them that change with time.
std::vector<std::string_view> animatedUsdLightSizes(const UsdPrim& light);

/// Area of a light's emitting surface in the world, scene units squared; 0 if a size is not
/// positive. \param toWorld local frame to world, column vectors, scene units; any scale and shear
double usdLightArea(const UsdAttributes& light, const glm::dmat4& toWorld);

/// The node of a RectLight, DiskLight, SphereLight or CylinderLight (an open tube of 24 sides, as
/// large as the cylinder, black and emitting outwards). \param name of the node. Null, with a
/// warning, if it has no area.
NodePtr makeUsdLight(const std::string& name, const UsdAttributes& light, const glm::dmat4& toWorld,
                     Diagnostics& diagnostics);

/// Lights at infinity and portals: understood, but not in the scene graph yet.
bool isUsdLightWithoutArea(std::string_view typeName);
bool isUsdAreaLight(std::string_view typeName);

} // namespace penumbra
