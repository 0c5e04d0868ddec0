// How the lit things of a scene stand.
#pragma once

#include "viewer/preview/PreviewLighting.h"

#include <span>
#include <string>
#include <vector>

namespace penumbra {

class RadiosityNode;
struct PlacedScene;

/// What a lamp below a node sends light from, where it stands as of its last update(): the emitters
/// that radiosity has of a light, or of a mesh that shines. None: it is hidden, or there is no such
/// lamp. \param lamp its path, see Placed
std::vector<Emitter> emittersOf(const RadiosityNode& node, const std::string& source);
/// What it shines with, pi L [lm/m^2].
Rgb exitanceOf(const PlacedScene& placed, const std::string& source);

/// How the objects of a node stand as of its last update(), and where lamps are.
/// \param lamps their paths
SceneState sceneStateOf(const RadiosityNode& node, std::span<const std::string> lights);

/// Whether there are shadow maps for a lamp: a rectangle, a disk or a sphere that is not stretched
/// to something else.
bool hasShadowMaps(std::span<const Emitter> source);

/// The same lamp in the same place, or none both times.
bool sameLight(std::span<const Emitter> a, std::span<const Emitter> b);
/// The same objects and lamps in the same places.
bool sameSceneState(const SceneState& a, const SceneState& b);

} // namespace penumbra
