// Greedy merging of parts of a surface, the cheapest pair first.
#pragma once

#include "radiosity/clusters/MicroClusters.h"
#include "radiosity/surface/UnionFind.h"

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <queue>
#include <span>
#include <vector>

namespace penumbra {

/// What a pair must keep within to be merged.
struct MergeLimits {
    float extent = 0;                                      ///< [m]
    double area = std::numeric_limits<double>::infinity(); ///< [m^2]
    bool coherent = true;                                  ///< within cone and flatness as well
};

/// Merges micro clusters, and keeps the tree of what was merged with what.
///
/// The cheapest pair is merged first; its cost is
///
///     A/s^2 (12 v/s^2 + 2 (1 - |S|/A)) + 1/4 (e/s)^2
///
/// with the area A, the vector area S, the extent e, the mean square distance v from the mean plane
/// and the size s. Costs have 6 bits of mantissa, and ties fall by address, so that neither the
/// order of faces nor a compiler's rounding decides. A part bears the number of its least member.
///
/// After [Garland2001]; departures: another cost, limits, and parts that need not touch.
class ClusterMerger {
public:
    using Pair = std::array<std::uint32_t, 2>;
    struct Settings {
        double size = 0.4;              ///< s [m]
        double coneCosine = 0.70710678; ///< of the half-angle of the cone of normals
        double flatness = 0.2;          ///< greatest thickness / extent
    };

    ClusterMerger(const MicroClusters& micro, const Settings& settings);

    /// Merges along `pairs` of parts and, where parts have grown together, along all their pairs.
    void merge(std::span<const Pair> pairs, const MergeLimits& limits);
    /// Whether parts a and b keep within the limits together.
    bool mayMerge(std::uint32_t a, std::uint32_t b, const MergeLimits& limits) const;

    /// The parts that are left, by address.
    std::vector<std::uint32_t> parts() const;
    const ClusterPart& part(std::uint32_t part) const { return parts_[part]; }
    std::uint32_t materialOf(std::uint32_t part) const { return micro_.materials[part]; }
    /// Whether no normal is outside of the cone around the mean normal.
    bool withinCone(std::uint32_t part) const;

    /// Cuts a part's tree into at most `most` nodes: again and again the largest is split.
    std::vector<std::uint32_t> cut(std::uint32_t part, std::size_t most) const;
    /// Calls visit(micro cluster) for all below a node.
    template <class Visit>
    void forEachLeaf(std::uint32_t node, const Visit& visit) const {
        if (node < micro_.size()) return visit(node);
        std::vector<std::uint32_t> open{node};
        while (!open.empty()) {
            const std::uint32_t top = open.back();
            open.pop_back();
            if (top < micro_.size())
                visit(top);
            else
                for (std::uint32_t child : merges_[top - micro_.size()].children)
                    open.push_back(child);
        }
    }

private:
    struct Merge {
        std::array<std::uint32_t, 2> children;
        double area;
    };
    /// A pair in the queue: void once either part has become another node.
    struct Candidate {
        std::uint32_t cost; // quantised
        Pair parts, nodes;
        bool operator>(const Candidate& other) const {
            return cost != other.cost ? cost > other.cost : parts > other.parts;
        }
    };

    bool offer(std::uint32_t a, std::uint32_t b, const MergeLimits& limits);
    std::optional<double> cost(std::uint32_t a, std::uint32_t b, const MergeLimits& limits) const;
    bool wouldFitCone(std::uint32_t a, std::uint32_t b) const;
    bool ringWithin(std::uint32_t start, glm::dvec3 axis) const;
    void join(Pair pair);
    void joinNeighbours(Pair pair, const MergeLimits& limits);
    double areaOf(std::uint32_t node) const;

    const MicroClusters& micro_;
    Settings settings_;
    std::vector<ClusterPart> parts_;
    std::vector<std::uint32_t> nodes_; // of each part: a micro cluster, or their count + a merge
    std::vector<std::uint32_t> ring_;  // next micro cluster of the same part
    std::vector<Merge> merges_;
    UnionFind joined_;
    std::vector<std::vector<std::uint32_t>> neighbours_; // of the parts, perhaps merged since
    std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> queue_;
};

} // namespace penumbra
