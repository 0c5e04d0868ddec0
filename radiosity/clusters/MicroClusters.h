// The first, linear step of clustering: faces that share a cell and a bin of normals.
#pragma once

#include "radiosity/clusters/AddressedFaces.h"
#include "radiosity/clusters/FaceMoments.h"
#include "radiosity/clusters/Slabs.h"

#include <array>
#include <cstdint>
#include <vector>

namespace penumbra {

/// Unit normals around an axis.
struct NormalCone {
    glm::dvec3 axis{0};
    double cosine = 1; ///< of the greatest angle between the axis and a normal
};

/// What clustering needs to know of a set of faces.
struct ClusterPart {
    FaceMoments moments;
    Slabs slabs;
};

/// Connected faces of one material that share a cell and a bin of normals; a face that is too long
/// for a cell is alone. Sorted by address: the least of its faces' addresses.
struct MicroClusters {
    std::vector<std::uint32_t> ofFace; ///< one of each addressed face
    std::vector<std::uint64_t> addresses;
    std::vector<std::uint32_t> materials;
    std::vector<ClusterPart> parts;
    std::vector<NormalCone> cones;
    /// Pairs of one material that share an edge, the lesser first, sorted.
    std::vector<std::array<std::uint32_t, 2>> touching;

    std::size_t size() const { return parts.size(); }
};

MicroClusters clusterByCells(const AddressedFaces& faces);

} // namespace penumbra
