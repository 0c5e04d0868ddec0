// The rays that following a move cannot do without: what an update is compared with.
#pragma once

#include "radiosity/mesh/PatchSet.h"
#include "radiosity/rays/RayScene.h"
#include "radiosity/rows/Row.h"
#include "radiosity/transport/SceneChange.h"

#include <cstdint>
#include <span>

namespace penumbra {

/// Direct light, one object moved; others may have been meshed anew for it where they stand. Of
/// every pair of an emitter and a vertex:
///
/// - own: the emitter or the vertex belongs to one of these objects, not both to the same: every
///   sample;
/// - uncovered: the object laid bare or covered the vertex, which is lit elsewhere now: every
///   sample;
/// - released: samples that the moved object is on record for blocking before the move;
/// - met: samples that were visible and whose segment meets the object's box after it;
/// - refined: samples that are taken after the move only, since the first ones disagree now.
///
/// Found by going through all pairs, by none of the means by which the solver finds them. Samples
/// whose state turns are among these: nothing else can turn.
struct LeastRays {
    std::uint64_t own = 0, uncovered = 0, released = 0, met = 0, refined = 0; ///< [rays]
    std::uint64_t ownEntries = 0;  ///< own and unoccluded form factor above 0
    std::uint64_t selfEntries = 0; ///< emitter and vertex both belong to the object: no ray
    std::uint64_t selfRays = 0;    ///< what evaluating these anew would take
    double wall = 0, cpu = 0;      ///< tracing these rays by RayScene and doing nothing else [s]

    std::uint64_t total() const { return own + uncovered + released + met + refined; }
};

/// \param set, rays after the move \param change the moved object is the first one \param samples
/// see SolverOptions \param before rows of a new solver before the move \param after rows after it
LeastRays leastRays(const PatchSet& set, const RayScene& rays, int samples,
                    const SceneChange& change, std::span<const Row> before,
                    std::span<const Row> after);

} // namespace penumbra
