// From the scene graph to flat arrays.
#pragma once

#include "base/Progress.h"
#include "radiosity/mesh/Enclosure.h"
#include "radiosity/mesh/PatchSet.h"
#include "scenegraph/Objects.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace penumbra {

class Light;
class Material;

struct MeshingOptions {
    float patchSize =
        0; ///< longest edge of a patch [m]; 0: follows the scene, see defaultPatchSize()
    float elementSize = 0; ///< longest edge of an element [m]; 0: an eighth of a patch
    /// Surfaces of this area, and larger ones, are backdrops (see Backdrops.h) [m^2]; 0: found when
    /// the scene is meshed.
    double backdropArea = 0;
};

/// The sizes that a scene was meshed with. A scene in which things have moved is meshed alike with
/// these, but perhaps not with sizes that follow the scene.
inline MeshingOptions sizesOf(const PatchSet& set) {
    return {set.patchSize, set.elementSize, set.backdropArea};
}

/// The node that a colour or an exitance was taken from; one of the two. Owned by the scene.
struct LightSource {
    const Material* material = nullptr;
    const Light* light = nullptr;
};

/// A patch set, where it comes from, and what was noticed on the way.
struct BuiltPatches {
    PatchSet patches;
    std::vector<LightSource> materialSources; ///< one a material
    std::vector<std::uint8_t> materialEmits;  ///< 0: the back of an emitting surface, or no light
    std::vector<LightSource> emitterSources;  ///< one an emitter
    Enclosures enclosures;
    std::vector<std::string> warnings; ///< one line each, for people
};

/// Meshes `scene`: surfaces are cut into patches and elements, lights become emitters. Each object
/// is meshed in a frame of its own, as if nothing touched it, and brought to its pose; a Coverage
/// sees to what it touches. \throws Error if the scene is too wide to trace rays in, or would make
/// too many elements
BuiltPatches buildPatches(const PlacedScene& scene, const MeshingOptions& options = {},
                          const Progress& progress = {});

/// The same, of objects that stand in a scene with others, and are alone in `scene`.
/// \param sizes those of the others
/// \param lights of the others: points in front of what emits, see Enclosures [m, world]
BuiltPatches buildObjects(const PlacedScene& scene, const MeshingOptions& sizes,
                          std::span<const glm::vec3> lights, const Progress& progress = {});

/// The same sizes, with those that follow the scene filled in: what buildPatches() would choose.
/// They are to be resolved once, for the scene as it is at its start, or a thing that grows
/// later would change how all others are meshed.
MeshingOptions resolvedSizes(const PlacedScene& scene, MeshingOptions sizes);

/// sqrt(area / 1650), so that a room has some thousand patches whether it is half a metre wide or
/// ten; beyond half a metre the number grows before the size does, up to sqrt(area / 6000). There
/// backdrops (see Backdrops.h) are not counted: a ground of hundreds of metres does not make
/// patches of metres in the room that stands on it. A backdrop itself is cut into no more than
/// some 6000 patches, and elements in proportion, whatever the sizes are.
/// \param area of all surfaces that count [m^2]
float defaultPatchSize(double area);

} // namespace penumbra
