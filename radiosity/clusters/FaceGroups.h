// Which faces send light as one patch.
#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace penumbra {

/// A face, or a piece that it was cut into, that may send with others.
struct FacePiece {
    std::span<const glm::vec3> outline; ///< convex [m, frame of the object]
    std::uint32_t material = 0;
};

/// Groups those pieces of one side of an object that are smaller than some elements, and slivers:
/// dense meshes cost as their area does, not as their polygons. Pieces meet others of about their
/// own extent only. What is left is a patch of its own each.
/// \param patchSize, elementSize as meshing takes them [m]
/// \return indices into `faces`, group by group; those of a group in an order in which near ones
/// that look the same way follow on each other. A function of the faces alone, see FaceClusters.h.
std::vector<std::vector<std::uint32_t>> groupFaces(std::span<const FacePiece> faces,
                                                   float patchSize, float elementSize);

} // namespace penumbra
