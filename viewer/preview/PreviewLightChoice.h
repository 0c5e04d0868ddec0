// Which lights matter to a thing.
#pragma once

#include "radiosity/mesh/PatchSet.h"
#include "radiosity/query/SceneRays.h"
#include "scenegraph/Objects.h"
#include "viewer/preview/Preview.h"

#include <cstddef>
#include <string>
#include <vector>

namespace penumbra {

class RadiosityNode;

/// A light or an emissive mesh.
struct PreviewLight {
    std::string path;
    ObjectId object;
    std::vector<Emitter> emitters; ///< [m, world]
};

/// The lights below a node that are on, are shown and can be previewed: by rays all UsdLux lights
/// and meshes of which all emitting faces have one luminance, by maps rectangles, disks and
/// spheres.
std::vector<PreviewLight> previewableLights(const RadiosityNode& node, PreviewMethod by);

struct PreviewLimits {
    std::size_t most = kMostPreviewed; ///< emitters: each costs as much as another light
    double least = 0;                  ///< share of all light that a light has to have
    bool hidden = true;                ///< lights that the object does not see now, as well
};
PreviewLimits previewLimits(PreviewMethod by);

/// The lights to be previewed while an object moves, the most important ones first: those in it,
/// then those that give it the most light, of which it may take the most away from what lies
/// behind it. Of an emitter that gives E without obstacles and is seen from a share v of the object
/// (its corners and its middle), E v counts. Lights that are not seen come last, as if half a
/// corner saw them: the object may be moved into their light. Lights that are turned away from it
/// give none.
///
/// \param object in `rays`, as PreviewLight::object \return paths
std::vector<std::string> lightsThatMatter(const std::vector<PreviewLight>& lights,
                                          const SceneRays& rays, ObjectId object,
                                          const PreviewLimits& limits);

} // namespace penumbra
