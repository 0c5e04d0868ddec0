// Where the lit things of a scene are at one time.
#pragma once

#include "viewer/preview/PreviewLighting.h"

#include <span>
#include <string>
#include <vector>

namespace penumbra {

class RadiosityNode;
struct PlacedScene;

/// The emitters of a light below a node, where they are as of its last update(): those that
/// radiosity has of a UsdLux light or of an emissive mesh. None: it is hidden, or there is no such
/// light. \param source its path, see Placed
std::vector<Emitter> emittersOf(const RadiosityNode& node, const std::string& source);
/// Its exitance, pi L [lm/m^2].
Rgb exitanceOf(const PlacedScene& placed, const std::string& source);

/// Where the objects of a node are as of its last update(), and where lights are.
/// \param lights their paths
SceneState sceneStateOf(const RadiosityNode& node, std::span<const std::string> lights);

/// Whether there are shadow maps for a light: a rectangle, a disk or a sphere that is not stretched
/// to something else.
bool hasShadowMaps(std::span<const Emitter> source);

/// The same light in the same pose, or none both times.
bool sameLight(std::span<const Emitter> a, std::span<const Emitter> b);
/// The same objects and lights in the same poses.
bool sameSceneState(const SceneState& a, const SceneState& b);

} // namespace penumbra
