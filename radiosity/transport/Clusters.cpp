#include "radiosity/transport/Clusters.h"

#include "base/Axis.h"
#include "base/Bounds.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

namespace penumbra {

namespace {

constexpr std::uint32_t kSmallest = 4; ///< patches: a cluster of so many is not split
constexpr float kThin = 4;             ///< how much more thickness counts than width

/// The face of a cube that a direction points to, 0 ... 5.
int faceOf(glm::vec3 direction) {
    const int axis = longestAxis(glm::abs(direction));
    return 2 * axis + (direction[axis] < 0);
}

/// The axis along which all of some patches face, one way or the other, or -1.
int commonAxis(std::span<const ClusterPatch> patches) {
    const int axis = faceOf(patches[0].normal) / 2;
    const auto isAlong = [&](const ClusterPatch& p) { return faceOf(p.normal) / 2 == axis; };
    return std::ranges::all_of(patches, isAlong) ? axis : -1;
}

/// Halves a box of patches where it is longest.
/// \param thin axis along which length counts more, or -1 \return how many come first
std::size_t halve(std::span<ClusterPatch> patches, int thin) {
    Bounds box;
    for (const ClusterPatch& patch : patches) box.add(patch.centre);
    glm::vec3 size = box.size();
    if (thin >= 0) size[thin] *= kThin;
    const int axis = longestAxis(size);
    const float middle = box.centre()[axis];
    const auto half =
        std::stable_partition(patches.begin(), patches.end(),
                              [&](const ClusterPatch& p) { return p.centre[axis] < middle; });
    const auto count = std::size_t(half - patches.begin());
    return count == 0 || count == patches.size() ? patches.size() / 2 : count; // all at one point
}

} // namespace

Clusters::Clusters(std::span<const ClusterPatch> patches, float smallArea) {
    constexpr int kSmall = 6;
    const auto kindOf = [&](const ClusterPatch& p) {
        return p.area < smallArea ? kSmall : faceOf(p.normal);
    };
    std::vector<ClusterPatch> sorted(patches.begin(), patches.end());
    std::ranges::stable_sort(sorted, {}, kindOf);
    clusterAt_.assign(sorted.size(), kNone);
    for (std::uint32_t first = 0, last = 0; first < sorted.size(); first = last) {
        while (last < sorted.size() && kindOf(sorted[last]) == kindOf(sorted[first])) ++last;
        split(std::span(sorted).subspan(first, last - first), first, kNone);
    }
    for (const ClusterPatch& patch : sorted) order_.push_back(patch.index);
    for (Cluster& cluster : clusters_)
        cutIntoParts(cluster, std::span(sorted).subspan(cluster.first, cluster.count));
}

/// Makes a cluster of patches and halves it.
std::uint32_t Clusters::split(std::span<ClusterPatch> patches, std::uint32_t first,
                              std::uint32_t parent) {
    if (patches.size() < 2) return kNone; // a patch represents itself
    const auto index = std::uint32_t(clusters_.size());
    clusters_.push_back({});
    clusters_[index].parent = parent;
    clusters_[index].first = first;
    clusters_[index].count = std::uint32_t(patches.size());
    std::fill_n(clusterAt_.begin() + first, patches.size(), index);
    if (patches.size() <= kSmallest) return index;

    const auto count = std::uint32_t(halve(patches, commonAxis(patches)));
    const std::uint32_t low = split(patches.first(count), first, index);
    const std::uint32_t high = split(patches.subspan(count), first + count, index);
    clusters_[index].children = {low, high};
    return index;
}

namespace {

/// Patches of a cluster, or a quarter of a single one.
struct Piece {
    std::span<ClusterPatch> patches;
    std::uint8_t quarter = Clusters::kWhole;
    double area = 0; ///< [m^2]
};

Piece pieceOf(std::span<ClusterPatch> patches) {
    double area = 0;
    for (const ClusterPatch& patch : patches) area += double(patch.area);
    return {patches, Clusters::kWhole, area};
}

using Pieces = std::vector<Piece>;

/// Into halves, or a single patch into quarters.
Pieces cut(const Piece& piece) {
    if (piece.patches.size() > 1) {
        const std::size_t low = piece.patches.size() > kSmallest
                                    ? halve(piece.patches, faceOf(piece.patches[0].normal) / 2)
                                    : piece.patches.size() / 2;
        return {pieceOf(piece.patches.first(low)), pieceOf(piece.patches.subspan(low))};
    }
    Pieces quarters;
    for (std::uint8_t q = 0; q < 4; ++q) quarters.push_back({piece.patches, q, piece.area / 4});
    return quarters;
}

/// Cuts the largest again and again, as long as there are not too many.
Pieces cutUpTo(std::size_t most, Pieces pieces) {
    for (;;) {
        auto largest = pieces.end();
        for (auto p = pieces.begin(); p != pieces.end(); ++p) {
            const std::size_t more = p->patches.size() > 1 ? 1 : 3;
            if (p->quarter == Clusters::kWhole && pieces.size() + more <= most &&
                (largest == pieces.end() || p->area > largest->area))
                largest = p;
        }
        if (largest == pieces.end()) return pieces;
        const Pieces cutUp = cut(*largest);
        const auto at = pieces.erase(largest);
        pieces.insert(at, cutUp.begin(), cutUp.end());
    }
}

/// What faces ways that can be seen at once sends as one quarter.
struct Quarter {
    Pieces pieces;
    double area() const {
        double area = 0;
        for (const Piece& piece : pieces) area += piece.area;
        return area;
    }
    bool isSeenWith(const Quarter& other) const {
        const auto opposite = [](const Piece& a, const Piece& b) {
            return (faceOf(a.patches[0].normal) ^ 1) == faceOf(b.patches[0].normal);
        };
        return std::ranges::none_of(pieces, [&](const Piece& a) {
            return std::ranges::any_of(other.pieces,
                                       [&](const Piece& b) { return opposite(a, b); });
        });
    }
};

/// Joins the two smallest that can be seen at once, until there are four.
void joinIntoFour(std::vector<Quarter>& quarters) {
    while (quarters.size() > 4) {
        std::size_t one = 0, other = 0;
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < quarters.size(); ++i)
            for (std::size_t j = i + 1; j < quarters.size(); ++j) {
                const double area = quarters[i].area() + quarters[j].area();
                if (!(area < least) || !quarters[i].isSeenWith(quarters[j])) continue;
                least = area, one = i, other = j;
            }
        std::ranges::copy(quarters[other].pieces, std::back_inserter(quarters[one].pieces));
        quarters.erase(quarters.begin() + std::ptrdiff_t(other));
    }
}

/// \param patches by the way that they face \return four at most, of four parts at most
std::vector<Quarter> quartersOf(std::span<ClusterPatch> patches) {
    Pieces sides;
    for (std::size_t first = 0, last = 0; first < patches.size(); first = last) {
        const int face = faceOf(patches[first].normal);
        while (last < patches.size() && faceOf(patches[last].normal) == face) ++last;
        sides.push_back(pieceOf(patches.subspan(first, last - first)));
    }
    std::vector<Quarter> quarters;
    if (sides.size() == 1) {
        const Pieces parts = cutUpTo(Clusters::kParts, std::move(sides));
        for (std::size_t q = 0; q < 4; ++q) {
            const auto at = [&](std::size_t i) {
                return parts.begin() + std::ptrdiff_t(i * parts.size() / 4);
            };
            quarters.push_back({{at(q), at(q + 1)}});
        }
        return quarters;
    }
    if (sides.size() < 4) sides = cutUpTo(4, std::move(sides));
    for (const Piece& side : sides) quarters.push_back({{side}});
    joinIntoFour(quarters);
    for (Quarter& quarter : quarters)
        quarter.pieces = cutUpTo(Clusters::kParts / 4, std::move(quarter.pieces));
    return quarters;
}

} // namespace

void Clusters::cutIntoParts(Cluster& cluster, std::span<const ClusterPatch> patches) {
    std::vector<ClusterPatch> own(patches.begin(), patches.end());
    std::ranges::stable_sort(own, {}, [](const ClusterPatch& p) { return faceOf(p.normal); });
    const auto begin = std::uint32_t(members_.size());
    std::size_t q = 0;
    for (const Quarter& quarter : quartersOf(own)) {
        Part* part = &cluster.parts[kParts / 4 * q++];
        for (const Piece& piece : quarter.pieces)
            *part++ = {begin + std::uint32_t(piece.patches.data() - own.data()),
                       std::uint32_t(piece.patches.size()), piece.quarter};
    }
    for (const ClusterPatch& patch : own) members_.push_back(patch.index);
}

} // namespace penumbra
