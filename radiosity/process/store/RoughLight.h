// Light for the first picture of a scene: roughly right, and there at once.
#pragma once

#include "base/Rgb.h"
#include "radiosity/mesh/PatchSet.h"
#include "radiosity/rays/RayScene.h"

#include <cstddef>
#include <vector>

namespace penumbra {

/// Shown until the direct light of a scene that was opened is known, and the first of the indirect.
struct RoughLight {
    std::vector<Rgb> direct; ///< illuminance at vertices [lux]
    /// About what all interreflection adds, the same everywhere [lux]: what is reflected of the
    /// direct light goes once over all surfaces, and is reflected on [Cohen1988].
    Rgb ambient;

    bool empty() const { return direct.empty(); }
};

/// Few shadow rays an emitter and receiver, and none that is remembered.
/// \param most pairs of an emitter and a receiver that are worth it; of more, some receivers of
/// each
///        block are traced, by more rays, and the others guessed from them (CoarseBlock)
/// \return empty if those are more still, or there is no emitter
RoughLight roughLight(const PatchSet& set, const RayScene& rays, std::size_t most = 6'000'000);

} // namespace penumbra
