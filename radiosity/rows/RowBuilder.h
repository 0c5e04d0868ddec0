// Fills rows of the shadow-form-factor-list.
#pragma once

#include "radiosity/rows/EmitterRowBuilder.h"
#include "radiosity/rows/PatchRowBuilder.h"

#include <vector>

namespace penumbra {

/// Builds and updates blocks of rows; one a thread. An updated block is the same as a block built
/// anew, but for the choice among several objects that block a sample:
///
/// - samples that a moved object blocked are traced again;
/// - samples that were visible are traced against the moved objects alone;
/// - what something else blocks stays blocked.
struct RowBuilder {
    explicit RowBuilder(const RayScene& rays) : emitters(rays), patches(rays) {}

    /// Rays since the last call.
    RayCount takeRayCount() { return emitters.takeRayCount() += patches.takeRayCount(); }

    EmitterRowBuilder emitters; ///< direct light
    PatchRowBuilder patches;    ///< indirect light

    /// Whose walls hide some of the block that is being updated from its sender altogether. Whoever
    /// updates it says so, whoever has it updated takes them.
    std::vector<ObjectId> occluders;
};

} // namespace penumbra
