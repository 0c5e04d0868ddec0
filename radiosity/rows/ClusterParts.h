// How a cluster of small faces sends: by parts, each through its vector area.
#pragma once

#include "radiosity/mesh/PatchSet.h"
#include "radiosity/rows/SenderSamples.h"

#include <glm/glm.hpp>

#include <array>
#include <numbers>

namespace penumbra {

/// A piece of a sender as it is seen from far away.
struct SenderPart {
    glm::vec3 centre{}; ///< [m, world]
    glm::vec3 normal{}; ///< mean, unit
    float area = 0;     ///< as its mean normal sees it [m^2]
};

/// kPatchSamples parts of a patch that is a cluster, all of the same area, and a point on each.
struct ClusterParts {
    std::array<SenderPart, kPatchSamples> parts;
    std::array<glm::vec3, kPatchSamples> samples; ///< roundingAt() over the surface [m, world]
};

/// Cuts the elements of a cluster into parts as they follow on each other.
///
/// After [Willmott1999]: a part sends as its vector area does, its kernel clamped where receiver or
/// part face away. No outline is integrated: faces that are turned away would be taken off.
ClusterParts partsOf(const PatchSet& set, const Patch& patch);

/// Form factor of a disk of an area [m^2]. \param cosines see facing(), above 0
inline float diskKernel(float area, float cosines, float d2) {
    return area * cosines / (d2 * (std::numbers::pi_v<float> * d2 + area));
}

/// Unoccluded form factor from a receiver to a part, as of a disk of its area in front of it: never
/// above 1, whatever the distance.
float partFormFactor(const Receiver& receiver, const SenderPart& part);

} // namespace penumbra
