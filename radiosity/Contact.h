// Where surfaces touch: which corners of an element lie free, and where their light is to be taken.
#pragma once

#include "radiosity/PatchSet.h"
#include "radiosity/RayScene.h"

#include <cstdint>
#include <span>
#include <vector>

namespace penumbra {

/// A corner that is covered by another object (the floor under a cabinet, the wall behind a shelf)
/// or that lies beyond one (the floor on the other side of a partition) must lend neither its
/// darkness nor its light to the element's free part. Such an element gets a corner of its own
/// instead: drawn at the same place, lit where the way from the element's free middle ends.
///
/// Changes `elements` to use such private vertices, which are appended to `vertices` and
/// `coordinates`, and moves every receiver clear of the edges of its surface.
/// \param skin    how far receivers hover over the surface [m]
/// \return        for each element whether any of it is free
std::vector<std::uint8_t> resolveContacts(const RayScene& rays, std::span<const RayMesh> meshes,
                                          float skin, std::vector<Element>& elements,
                                          std::vector<Vertex>& vertices,
                                          std::vector<PatchCoordinate>& coordinates);

/// How a point that hovers over a surface lies.
enum class Lie {
    free,
    covered, ///< by something nearer than the distance that was asked for
    buried   ///< inside of something solid
};
/// \param cover [m], see coverDistance()
Lie lieOf(const RayScene& rays, std::span<const RayMesh> meshes, glm::vec3 point, glm::vec3 normal,
          float cover);

/// Something this close above a surface with elements of this size counts as lying on it [m].
float coverDistance(float elementSize, float skin);

} // namespace penumbra
