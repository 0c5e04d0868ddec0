// Lights of models as lights of USD.
#pragma once

#include "io/usd/layer/UsdDiagnostic.h"
#include "io/usd/layer/UsdLayer.h"

#include <glm/glm.hpp>

#include <optional>
#include <string>

struct aiLight;

namespace penumbra {

/// A light in the frame of its node.
struct ModelLight {
    enum class Kind { point, spot, rect, directional, ambient, unknown };
    std::string name;
    Kind kind = Kind::unknown;
    glm::dvec3 intensity{0};        ///< [cd] of point and spot lights and along a rect's normal
    glm::dmat4 toParent{1};         ///< of the node, if the light stands for it
    glm::dvec3 position{0};         ///< in units of the file
    glm::dvec3 direction{0, 0, -1}; ///< not of points
    double outerCone = 0;           ///< of a spot: half of its angle [rad]
    glm::dvec2 size{0};             ///< of a rect, in units of the file
};

/// Radius [m] of the sphere that a point becomes: without an area it can't be a light of
/// radiosity.
inline constexpr double kPointRadius = 0.05;

ModelLight modelLightOf(const aiLight& light);

/// A SphereLight of radius r = kPointRadius with the intensity I of the point or spot [cd]: seen
/// from afar it has the area pi r^2, hence the luminance
///
///     L = I / (pi r^2)  [nit]
///
/// A spot has its cone as UsdLux shaping. A RectLight of area A has L = I / A. None, with a
/// warning, for lights that have no place (directional, ambient, unknown).
///
/// \param toWorld of the node (toParent included), column vectors, in units of the file: the
///                sphere keeps its radius
/// \param unit    metres a unit
/// \param where   the file, for the warning
std::optional<UsdPrimSpec> lightPrim(const ModelLight& light, const std::string& name,
                                     const glm::dmat4& toWorld, double unit,
                                     const SourceLocation& where, Diagnostics& diagnostics);

} // namespace penumbra
