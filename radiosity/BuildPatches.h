// From the scene graph to flat arrays.
#pragma once

#include "radiosity/PatchSet.h"
#include "scenegraph/Objects.h"

#include <string>
#include <vector>

namespace penumbra {

struct MeshingOptions {
    float patchSize =
        0; ///< longest edge of a patch [m]; 0: follows the scene, see defaultPatchSize()
    float elementSize = 0; ///< longest edge of an element [m]; 0: an eighth of a patch
};

/// A patch set and what was noticed on the way.
struct BuiltPatches {
    PatchSet patches;
    std::vector<std::string> warnings; ///< one line each, for people
};

/// Meshes what is visible in `scene`: surfaces are cut into patches and elements, corners that lie
/// under or inside of something are told from those that lie free, lamps become emitters.
/// \throws Error if the scene is too wide to trace rays in, or would make too many elements
BuiltPatches buildPatches(const PlacedScene& scene, const MeshingOptions& options = {});

/// sqrt(area / 1650), so that a room has some thousand patches whether it is half a metre wide or
/// ten; beyond half a metre the number grows before the size does, up to sqrt(area / 6000). \param
/// area of all surfaces [m^2]
float defaultPatchSize(double area);

} // namespace penumbra
