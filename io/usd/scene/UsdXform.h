// UsdGeomXformable: the transform of a prim in its parent.
#pragma once

#include "io/usd/layer/UsdDiagnostic.h"
#include "io/usd/stage/UsdAttributes.h"
#include "io/usd/stage/UsdSampleCheck.h"

#include <glm/glm.hpp>

namespace penumbra {

/// The composed xformOps of a prim.
struct UsdLocalTransform {
    glm::dmat4 matrix{1.0};   ///< local to parent frame, column vectors, scene units
    bool authored = false;    ///< xformOpOrder lists anything at all
    bool animated = false;    ///< an op in use has samples that differ
    bool resetsStack = false; ///< `!resetXformStack!`: the parent's frame is not inherited
};

/// Evaluates xformOpOrder. For column vectors the ops multiply in the order in which they are
/// listed:
///
///     M = op_1 * op_2 * ... * op_n
///
/// USD writes the same with row vectors, M = op_n * ... * op_1. rotateABC turns about A first. Ops
/// that can't be used (missing attribute, singular matrix to be inverted, values that aren't
/// finite) are skipped with a warning.
UsdLocalTransform usdLocalTransform(const UsdAttributes& prim, Diagnostics& diagnostics);

/// Warns of ops that can't be used at other times than that of the load.
void checkUsdTransform(const UsdPrim& prim, UsdSampleCheck& check);

/// The matrix that gives a prim its own transform whatever its parent's is: inverse(parent) *
/// local. Without the parent's inverse (a flattened parent) it is the local one.
glm::dmat4 relativeToParent(const UsdLocalTransform& local, const glm::dmat4& parentToWorld);

} // namespace penumbra
