// How the lit things of a scene stand.
#pragma once

#include "viewer/LiveLight.h"

#include <span>
#include <string>

namespace penumbra {

class RadiosityNode;

/// How the objects of a node stand as of its last update(), and where lamps are.
/// \param lamps their paths, see Placed<Light>
Arrangement arrangementOf(const RadiosityNode& node, std::span<const std::string> lamps);

/// Whether a lamp can be drawn live: a rectangle, a disk or a sphere that is not stretched to
/// something else.
bool canBeDrawnLive(const Emitter& lamp);

/// The same lamp in the same place, or none both times.
bool sameLamp(const std::optional<Emitter>& a, const std::optional<Emitter>& b);
/// The same objects and lamps in the same places.
bool sameArrangement(const Arrangement& a, const Arrangement& b);

} // namespace penumbra
