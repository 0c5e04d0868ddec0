// UsdGeomPointInstancer: where its instances stand.
#pragma once

#include "io/usd/layer/UsdDiagnostic.h"
#include "io/usd/stage/UsdAttributes.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <vector>

namespace penumbra {

/// One instance of a PointInstancer.
struct UsdInstance {
    std::size_t number = 0;    ///< which one of protoIndices
    std::size_t prototype = 0; ///< which target of `prototypes`
    /// The frame that the prototype's own transform leads to, to the instancer's: column vectors,
    /// scene units, translation * rotation * scale.
    glm::dmat4 toInstancer{1.0};
};

/// The instances that are drawn, in their order: not those of `invisibleIds` and `inactiveIds`.
/// `orientationsf` is taken before `orientations`. Arrays without one entry an instance are
/// ignored with a warning, without positions there are no instances; those with a number that is
/// not finite or beyond 1e7, or of a prototype that is not there, are left out with a warning.
/// Animated arrays are held.
/// \param prototypes how many there are
std::vector<UsdInstance> readUsdInstances(const UsdAttributes& instancer, std::size_t prototypes,
                                          Diagnostics& diagnostics);

} // namespace penumbra
