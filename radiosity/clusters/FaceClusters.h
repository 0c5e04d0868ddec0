// The faces of a mesh as clusters that send light together.
#pragma once

#include "radiosity/clusters/AddressedFaces.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace penumbra {

/// What face clusters keep within.
struct FaceClusterOptions {
    float size = 0.4f; ///< greatest extent [m]
    /// Cosine of the greatest angle between a normal and the cluster's mean normal: 45 degrees. Not
    /// an angle, since the cosine's last bit differs between C libraries.
    float coneCosine = 0.70710678f;
    float flatness = 0.2f; ///< greatest thickness / extent
    /// Faces of a greater extent than this share of `size`, at most 1, are not clustered.
    float largeShare = 0.5f;
    /// Parts of less than this share of `size` are joined whatever their normals.
    float fuzzyShare = 0.6f;
    std::uint32_t subClusters = 16; ///< most parts of a cluster that send on their own
    std::uint32_t neighbours = 4;   ///< that a part may be joined with without touching it
};

/// Faces of a cluster that lie together and look one way: one node of its merge tree.
struct SubCluster {
    glm::vec3 vectorArea{0};                    ///< integral of n dA [m^2]
    float area = 0;                             ///< [m^2]
    glm::vec3 centroid{0};                      ///< [m]
    std::uint32_t firstFace = 0, faceCount = 0; ///< of FaceClusters::faces
};

/// Faces that send light as one.
struct FaceCluster {
    /// Names the cluster: least address of its faces. Unique among those of a material.
    std::uint64_t address = 0;
    std::uint32_t material = 0;
    std::uint32_t firstFace = 0, faceCount = 0; ///< of FaceClusters::faces, by sub-cluster
    std::uint32_t firstSub = 0, subCount = 0;   ///< of FaceClusters::subClusters
    glm::vec3 vectorArea{0};                    ///< integral of n dA [m^2]
    float area = 0;                             ///< [m^2]
    glm::vec3 centroid{0};                      ///< [m]
    float extent = 0;                           ///< greatest width in 13 directions [m]
    glm::vec3 normal{0};                        ///< mean normal, unit; 0 if front and back cancel
    /// Has normals outside of the cone: to be sent through its sub-clusters or a table over
    /// directions, never through its vector area.
    bool fuzzy = false;
};

/// A mesh as clusters of faces; [m] and unit vectors in the mesh's own frame.
///
/// The result follows from positions, orientations and materials of the faces alone: whatever the
/// order of points, faces and corners, it is equal bit for bit (but for the numbers of the faces),
/// and an edit changes clusters near by only.
struct FaceClusters {
    std::vector<FaceCluster> clusters; ///< by address
    std::vector<SubCluster> subClusters;
    std::vector<std::uint32_t> faces; ///< of the soup, cluster by cluster
    /// Faces that are too large, by place: they keep a grid of patches.
    std::vector<std::uint32_t> large;
    /// Faces without area or not finite, and those that coincide with another, seen from the same
    /// side: rising.
    std::vector<std::uint32_t> dropped;

    std::span<const std::uint32_t> facesOf(const FaceCluster& cluster) const {
        return std::span(faces).subspan(cluster.firstFace, cluster.faceCount);
    }
    std::span<const SubCluster> subClustersOf(const FaceCluster& cluster) const {
        return std::span(subClusters).subspan(cluster.firstSub, cluster.subCount);
    }
};

/// Clusters the faces of one mesh. Faces that share a cell (size / 4) and a bin of normals are one
/// to begin with, which makes it linear; those are merged greedily: first along edges, then across
/// gaps of up to size / 4, both within size, cone and flatness; then what is small, whatever its
/// normals. Only faces of one material are merged.
///
/// After [Willmott1999]; greedy merging after [Garland2001].
FaceClusters clusterFaces(const PolygonSoup& soup, const FaceClusterOptions& options = {});

} // namespace penumbra
