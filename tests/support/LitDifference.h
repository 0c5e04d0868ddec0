// The comparison of two lit scenes of the same things.
#pragma once

#include "radiosity/transport/LitScene.h"

#include <string>

namespace penumbra {

/// What differs between two lit scenes of the same things, object by object: empty if visibility,
/// and what the rays for fine shadows meet, is the same bit for bit and radiosity agrees within
/// both certificates. An object that is hidden in one may be missing in the other.
std::string difference(const LitScene& a, const LitScene& b);

} // namespace penumbra
