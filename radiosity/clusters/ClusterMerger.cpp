#include "radiosity/clusters/ClusterMerger.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

namespace penumbra {

namespace {

/// A positive number's exponent and 6 bits of its mantissa, which are in order as the numbers are.
std::uint32_t quantised(double cost) {
    return std::uint32_t(std::bit_cast<std::uint64_t>(cost) >> (52 - 6));
}

double sineOf(double cosine) {
    return std::sqrt(std::max(0.0, 1 - cosine * cosine));
}

} // namespace

ClusterMerger::ClusterMerger(const MicroClusters& micro, const Settings& settings)
    : micro_(micro), settings_(settings), parts_(micro.parts), nodes_(micro.size()),
      ring_(micro.size()), joined_(micro.size()), neighbours_(micro.size()) {
    std::iota(nodes_.begin(), nodes_.end(), 0u);
    std::iota(ring_.begin(), ring_.end(), 0u);
}

void ClusterMerger::merge(std::span<const Pair> pairs, const MergeLimits& limits) {
    for (auto& list : neighbours_) list.clear();
    for (const auto& [a, b] : pairs) {
        if (!offer(a, b, limits)) continue;
        neighbours_[a].push_back(b);
        neighbours_[b].push_back(a);
    }
    while (!queue_.empty()) {
        const Candidate next = queue_.top();
        queue_.pop();
        const auto [a, b] = next.parts;
        if (nodes_[a] != next.nodes[0] || nodes_[b] != next.nodes[1]) continue;
        if (limits.coherent && !wouldFitCone(a, b)) continue;
        join(next.parts);
        joinNeighbours(next.parts, limits);
    }
}

bool ClusterMerger::mayMerge(std::uint32_t a, std::uint32_t b, const MergeLimits& limits) const {
    return materialOf(a) == materialOf(b) && cost(a, b, limits) &&
           (!limits.coherent || wouldFitCone(a, b));
}

/// Puts a pair into the queue if it keeps within the limits, but for the cone, which is dearer.
/// \return false if the pair is too wide or too large, and so will be whatever else they join
bool ClusterMerger::offer(std::uint32_t a, std::uint32_t b, const MergeLimits& limits) {
    const std::optional<double> price = cost(a, b, limits);
    if (!price) return false;
    const Pair pair{std::min(a, b), std::max(a, b)};
    if (*price < std::numeric_limits<double>::infinity())
        queue_.push({quantised(*price), pair, {nodes_[pair[0]], nodes_[pair[1]]}});
    return true;
}

/// Nothing if the pair is too wide or too large, infinity if it is too thick.
std::optional<double> ClusterMerger::cost(std::uint32_t a, std::uint32_t b,
                                          const MergeLimits& limits) const {
    Slabs slabs = parts_[a].slabs;
    slabs.add(parts_[b].slabs);
    const double extent = slabs.extent();
    const double area = parts_[a].moments.area + parts_[b].moments.area;
    if (extent > limits.extent || area > limits.area) return std::nullopt;

    FaceMoments moments = parts_[a].moments;
    moments.add(parts_[b].moments);
    // Twelve times the variance is the square of the thickness, of a slab and of a spherical cap.
    const double thickness2 = 12 * moments.variance(moments.normal());
    const double thickest = settings_.flatness * extent;
    if (limits.coherent && thickness2 > thickest * thickest)
        return std::numeric_limits<double>::infinity();
    const double size2 = settings_.size * settings_.size;
    const double spread = 2 * (1 - glm::length(moments.vectorArea) / area);
    return area / size2 * (thickness2 / size2 + std::max(0.0, spread)) +
           0.25 * extent * extent / size2;
}

bool ClusterMerger::wouldFitCone(std::uint32_t a, std::uint32_t b) const {
    FaceMoments moments = parts_[a].moments;
    moments.add(parts_[b].moments);
    const glm::dvec3 axis = moments.normal();
    return ringWithin(a, axis) && ringWithin(b, axis);
}

bool ClusterMerger::withinCone(std::uint32_t part) const {
    return ringWithin(part, parts_[part].moments.normal());
}

/// Whether the cones of a part's micro clusters lie within the cone around `axis`: of the angle to
/// the micro cluster's mean normal plus its own greatest angle.
bool ClusterMerger::ringWithin(std::uint32_t start, glm::dvec3 axis) const {
    std::uint32_t at = start;
    do {
        const NormalCone& cone = micro_.cones[at];
        const double between = glm::dot(axis, cone.axis);
        if (between < settings_.coneCosine) return false;
        const double sum = between * cone.cosine - sineOf(between) * sineOf(cone.cosine);
        if (sum < settings_.coneCosine) return false;
        at = ring_[at];
    } while (at != start);
    return true;
}

void ClusterMerger::join(Pair pair) {
    const auto [a, b] = pair;
    parts_[a].moments.add(parts_[b].moments);
    parts_[a].slabs.add(parts_[b].slabs);
    merges_.push_back({{nodes_[a], nodes_[b]}, parts_[a].moments.area});
    nodes_[a] = std::uint32_t(micro_.size() + merges_.size() - 1);
    nodes_[b] = 0xffffffffu; // no part any more: its pairs are void
    std::swap(ring_[a], ring_[b]);
    joined_.join(a, b);
}

/// What either of two parts touched, the one that they have become touches.
void ClusterMerger::joinNeighbours(Pair pair, const MergeLimits& limits) {
    const auto [a, b] = pair;
    std::vector<std::uint32_t> list = std::move(neighbours_[a]);
    list.insert(list.end(), neighbours_[b].begin(), neighbours_[b].end());
    neighbours_[b] = {};
    for (std::uint32_t& other : list) other = joined_.find(other);
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    std::erase_if(list, [&, self = a](std::uint32_t other) {
        return other == self || !offer(self, other, limits);
    });
    neighbours_[a] = std::move(list);
}

std::vector<std::uint32_t> ClusterMerger::parts() const {
    std::vector<std::uint32_t> left;
    for (std::uint32_t part = 0; part < nodes_.size(); ++part)
        if (nodes_[part] != 0xffffffffu) left.push_back(part);
    return left;
}

double ClusterMerger::areaOf(std::uint32_t node) const {
    return node < micro_.size() ? micro_.parts[node].moments.area
                                : merges_[node - micro_.size()].area;
}

std::vector<std::uint32_t> ClusterMerger::cut(std::uint32_t part, std::size_t most) const {
    std::vector<std::uint32_t> nodes{nodes_[part]};
    while (nodes.size() < most) {
        std::size_t largest = nodes.size();
        for (std::size_t i = 0; i < nodes.size(); ++i)
            if (nodes[i] >= micro_.size() &&
                (largest == nodes.size() || areaOf(nodes[i]) > areaOf(nodes[largest])))
                largest = i;
        if (largest == nodes.size()) break; // nothing left to split
        const auto [left, right] = merges_[nodes[largest] - micro_.size()].children;
        nodes[largest] = left;
        nodes.insert(nodes.begin() + std::ptrdiff_t(largest) + 1, right);
    }
    return nodes;
}

} // namespace penumbra
