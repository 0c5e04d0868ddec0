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

/// A vertex of a cluster of faces that may do without receiving light itself.
struct DenseVertex {
    std::uint32_t index = 0;
    glm::vec3 position{}, normal{};
};
/// Chooses receivers among the vertices of a cluster: as many as are an element apart or look
/// another way. \param known  receivers that it has already
/// \param among  in order, an earlier one is chosen rather
/// \return indices of those that are chosen
std::vector<std::uint32_t> chooseReceivers(std::vector<DenseVertex> known,
                                           std::span<const DenseVertex> among, float elementSize);
/// Fills in the blends of blended blocks: receivers of a vertex's own cluster and of those that
/// touch it, with weights as above. \pre blendNodes() was called
void blendVertices(PatchSet& set);

} // namespace penumbra
