// Light on dense meshes, in between the patches that they are clustered into.
#pragma once

#include "radiosity/mesh/PatchSet.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace penumbra {

/// Has the vertices of clusters take a weighted mean of the nodes of their own patch and of those
/// that touch it and look about the same way: never across a crease, nor from the back of a sheet.
/// Weights fall with the distance and the angle between the normals, to 0 at the fifth node.
///
/// After [Franke1980].
/// \pre objects are in frames of their own
void blendNodes(PatchSet& set);

/// Fills in the blends of blended blocks: receivers of a vertex's own cluster and of those that
/// touch it, with weights as above. \param flat one a vertex, see DenseVertex: those take from each
/// other only
/// \pre blendNodes() was called
void blendVertices(PatchSet& set, std::span<const std::uint8_t> flat);

} // namespace penumbra
