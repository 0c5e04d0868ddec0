#include "radiosity/transport/Clusters.h"

#include "base/Bounds.h"

#include <algorithm>
#include <cmath>

namespace penumbra {

namespace {

constexpr std::uint32_t kSmallest = 4; ///< patches: a cluster of so many is not split
constexpr float kThin = 4;             ///< how much more thickness counts than width

/// The face of a cube that a direction points to, 0 ... 5.
int faceOf(glm::vec3 direction) {
    const glm::vec3 size = glm::abs(direction);
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    return 2 * axis + (direction[axis] < 0);
}

} // namespace

Clusters::Clusters(std::span<const ClusterPatch> patches) {
    std::vector<ClusterPatch> sorted(patches.begin(), patches.end());
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const ClusterPatch& a, const ClusterPatch& b) {
                         return faceOf(a.normal) < faceOf(b.normal);
                     });
    clusterAt_.assign(sorted.size(), kNone);
    for (std::uint32_t first = 0; first < sorted.size();) {
        const int face = faceOf(sorted[first].normal);
        std::uint32_t last = first + 1;
        while (last < sorted.size() && faceOf(sorted[last].normal) == face) ++last;
        split(std::span(sorted).subspan(first, last - first), first, kNone, face / 2);
        first = last;
    }
    std::vector<float> areas;
    for (const ClusterPatch& patch : sorted) {
        order_.push_back(patch.index);
        areas.push_back(patch.area);
    }
    for (Cluster& cluster : clusters_) cutIntoParts(cluster, areas);
}

/// Makes a cluster of patches and halves it. \param thin the axis that they face along
std::uint32_t Clusters::split(std::span<ClusterPatch> patches, std::uint32_t first,
                              std::uint32_t parent, int thin) {
    if (patches.size() < 2) return kNone; // a patch represents itself
    const auto index = std::uint32_t(clusters_.size());
    clusters_.push_back({});
    clusters_[index].parent = parent;
    clusters_[index].first = first;
    clusters_[index].count = std::uint32_t(patches.size());
    std::fill_n(clusterAt_.begin() + first, patches.size(), index);
    if (patches.size() <= kSmallest) return index;

    Bounds box;
    for (const ClusterPatch& patch : patches) box.add(patch.centre);
    glm::vec3 size = box.size();
    size[thin] *= kThin;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const float middle = box.centre()[axis];
    auto half = std::stable_partition(patches.begin(), patches.end(), [&](const ClusterPatch& p) {
        return p.centre[axis] < middle;
    });
    if (half == patches.begin() || half == patches.end()) // all at one point
        half = patches.begin() + std::ptrdiff_t(patches.size() / 2);
    const auto count = std::uint32_t(half - patches.begin());
    const std::uint32_t low = split(patches.first(count), first, index, thin);
    const std::uint32_t high = split(patches.subspan(count), first + count, index, thin);
    clusters_[index].children = {low, high};
    return index;
}

/// The largest part is cut in two, or if it is one patch in four, until there are kParts.
void Clusters::cutIntoParts(Cluster& cluster, std::span<const float> areas) const {
    struct Piece {
        Part part;
        std::uint32_t cluster = kNone; ///< that has just these patches
        double area = 0;
    };
    const auto piece = [&](std::uint32_t first, std::uint32_t count, std::uint32_t of) {
        double area = 0;
        for (std::uint32_t i = first; i < first + count; ++i) area += double(areas[i]);
        return Piece{{first, count, kWhole}, of, area};
    };
    std::vector<Piece> pieces{
        piece(cluster.first, cluster.count, std::uint32_t(&cluster - clusters_.data()))};
    for (;;) {
        auto largest = pieces.end();
        for (auto p = pieces.begin(); p != pieces.end(); ++p) {
            const std::size_t more = p->part.count > 1 ? 1 : 3;
            if (p->part.quarter == kWhole && pieces.size() + more <= kParts &&
                (largest == pieces.end() || p->area > largest->area))
                largest = p;
        }
        if (largest == pieces.end()) break;
        const Piece whole = *largest;
        std::vector<Piece> cut;
        if (whole.part.count == 1) {
            for (std::uint8_t q = 0; q < 4; ++q)
                cut.push_back({{whole.part.first, 1, q}, kNone, whole.area / 4});
        } else if (const auto [low, high] = clusters_[whole.cluster].children;
                   low == kNone && high == kNone) { // a smallest one: in halves
            const std::uint32_t half = whole.part.count / 2;
            cut = {piece(whole.part.first, half, whole.cluster),
                   piece(whole.part.first + half, whole.part.count - half, whole.cluster)};
        } else {
            // A single patch has no cluster of its own.
            const std::uint32_t count = low != kNone ? clusters_[low].count : 1;
            cut = {piece(whole.part.first, count, low),
                   piece(whole.part.first + count, whole.part.count - count, high)};
        }
        const auto at = pieces.erase(largest);
        pieces.insert(at, cut.begin(), cut.end());
    }
    cluster.partCount = std::uint8_t(pieces.size());
    for (std::size_t i = 0; i < pieces.size(); ++i) cluster.parts[i] = pieces[i].part;
}

} // namespace penumbra
