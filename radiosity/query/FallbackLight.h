// What a scene without lights is seen by.
#pragma once

#include "radiosity/mesh/PatchSet.h"
#include "radiosity/transport/Lighting.h"
#include "scenegraph/Camera.h"

namespace penumbra {

/// Illuminance of what faces the eye in a scene without lights [lux]: half of it from all round,
/// half of it from a headlight, which falls off with the cosine.
inline constexpr float kFallbackIlluminance = 100;

/// The light of a headlight at the eye and an even one from all round, without shadows. It depends
/// on the view; all of it counts as indirect, since no emitter sends it.
Lighting fallbackLight(const PatchSet& patches, const View& view);

} // namespace penumbra
