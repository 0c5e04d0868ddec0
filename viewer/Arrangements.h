// How the lit things of a scene stand.
#pragma once

#include "viewer/LiveLight.h"

#include <span>
#include <string>
#include <vector>

namespace penumbra {

class RadiosityNode;
struct PlacedScene;

/// What a lamp below a node sends light from, where it stands as of its last update(): the emitters
/// that radiosity has of a light, or of a mesh that shines. None: it is hidden, or there is no such
/// lamp. \param lamp its path, see Placed
std::vector<Emitter> emittersOf(const RadiosityNode& node, const std::string& lamp);
/// What it shines with, pi L [lm/m^2].
Rgb exitanceOf(const PlacedScene& placed, const std::string& lamp);

/// How the objects of a node stand as of its last update(), and where lamps are.
/// \param lamps their paths
Arrangement arrangementOf(const RadiosityNode& node, std::span<const std::string> lamps);

/// Whether there are shadow maps for a lamp: a rectangle, a disk or a sphere that is not stretched
/// to something else.
bool hasShadowMaps(std::span<const Emitter> lamp);

/// The same lamp in the same place, or none both times.
bool sameLamp(std::span<const Emitter> a, std::span<const Emitter> b);
/// The same objects and lamps in the same places.
bool sameArrangement(const Arrangement& a, const Arrangement& b);

} // namespace penumbra
