// Patches put together, for receivers that are too far away to tell them apart.
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace penumbra {

/// What has to be known of a patch to put it into a cluster.
struct ClusterPatch {
    std::uint32_t index = 0; ///< names the patch
    glm::vec3 centre{};      ///< [m], in a frame in which the patches never move
    glm::vec3 normal{};      ///< unit
    float area = 0;          ///< [m^2]
};

/// Binary hierarchies of patches that lie near each other: of large ones that face more or less the
/// same way (the same face of a cube around them), one for each way, and of small ones whichever
/// way they face: small things that stand far away are one sender, not one for each of their sides.
/// Boxes are halved where they are longest; where all face along one axis thickness counts more
/// than width, so that these lie in thin slabs, are lit alike and seldom hide one another. A
/// cluster is cut into parts that face one way each: receivers see what of these faces them. Which
/// patches are put together depends on geometry alone ([Hanrahan1991], [Smits1994],
/// [Willmott1999]).
class Clusters {
public:
    static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
    static constexpr std::size_t kParts = 16;
    static constexpr std::uint8_t kWhole = 4; ///< a Part's quarter: all of it

    /// A piece of a cluster: patches, or a quarter of one.
    struct Part {
        std::uint32_t first = 0, count = 0; ///< members(): first ... first + count
        std::uint8_t quarter = kWhole;
    };
    struct Cluster {
        std::uint32_t parent = kNone;                        ///< a lower index, or none
        std::uint32_t first = 0, count = 0;                  ///< patches(): first ... first + count
        std::array<std::uint32_t, 2> children{kNone, kNone}; ///< clusters; none: single patches
        /// Four of each quarter: some of these may have no patches. What faces away from each other
        /// is in different quarters.
        std::array<Part, kParts> parts;
    };

    Clusters() = default;
    /// \param smallArea what has less is small [m^2]
    Clusters(std::span<const ClusterPatch> patches, float smallArea);

    const std::vector<Cluster>& clusters() const { return clusters_; }
    /// Indices of the patches, cluster by cluster.
    const std::vector<std::uint32_t>& patches() const { return order_; }
    /// The same, of each cluster part by part.
    const std::vector<std::uint32_t>& members() const { return members_; }
    /// The smallest cluster that has the patch in slot `i` of patches().
    std::uint32_t clusterAt(std::size_t i) const { return clusterAt_[i]; }

private:
    std::uint32_t split(std::span<ClusterPatch> patches, std::uint32_t first, std::uint32_t parent);
    void cutIntoParts(Cluster& cluster, std::span<const ClusterPatch> patches);

    std::vector<Cluster> clusters_;
    std::vector<std::uint32_t> order_, members_, clusterAt_;
};

} // namespace penumbra
