// What it will take to light a scene, before any of it is lit.
#pragma once

#include "radiosity/transport/LitScene.h"
#include "radiosity/transport/Solver.h"

#include <cstddef>

namespace penumbra {

/// What a first solution takes, to the exact state.
struct CostEstimate {
    double directRays = 0, indirectRays = 0, detailRays = 0; ///< the last: of fine shadows
    double directSeconds = 0, allSeconds = 0;                ///< of processor
    double directBytes = 0, allBytes = 0;                    ///< peak of the process
    double rowBytes = 0;                                     ///< of that, rows of patches at most
    double rowsKept = 1; ///< share of the rows of patches that have room; others are traced again
};

/// Traces samples of all that a solution does, at pairs that are spread over the whole scene and
/// are the same each time: blocks of some emitters and of some patches, what nodes see, and fine
/// shadows. Rays and bytes follow from these alone; times are measured, so that they are those of
/// this machine as it is now. Takes some tenths of a second.
///
/// What light does not reach is not known: where much of a scene is sealed, less is traced.
/// How often patches shoot is estimated from how much they reflect.
///
/// \param scene   meshed for direct light only, and not lit: a solver of all light is made beside
/// it,
///                so that what each takes before it begins is measured, too
/// \param options those of the solution
/// \pre residentMemory() is about what meshing the scene left
CostEstimate estimateCost(const LitScene& scene, const SolverOptions& options);

} // namespace penumbra
