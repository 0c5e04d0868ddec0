#include "radiosity/transport/Reach.h"

#include "base/Parallel.h"
#include "radiosity/mesh/NodePatches.h"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <utility>

namespace penumbra {

namespace {

/// Patch that a ray meets, Element::kNone: none that could light anything. What is covered is met
/// by rays that run into the very seam between what covers it and what is beside it.
std::uint32_t patchMet(const PatchSet& set, std::uint32_t hit) {
    if (hit == Element::kNone) return hit;
    const std::uint32_t element = hit & ~DetailRays::kAcross;
    if (element == NodeHits::kGone || !set.receives(element)) return Element::kNone;
    return set.elements[element].patch;
}

/// Which of some nodes see each patch, a list a patch.
struct Watchers {
    std::vector<std::uint32_t> first, nodes;

    Watchers(const PatchSet& set, const NodeHits& hits, std::span<const std::uint32_t> some)
        : first(set.patches.size() + 1) {
        const auto forEachMet = [&](auto visit) {
            for (const std::uint32_t n : some)
                for (const std::uint32_t hit : hits.hits(n))
                    if (const auto p = patchMet(set, hit); p != Element::kNone) visit(p, n);
        };
        forEachMet([&](std::uint32_t p, std::uint32_t) { ++first[p + 1]; });
        std::partial_sum(first.begin(), first.end(), first.begin());
        nodes.resize(first.back());
        std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
        forEachMet([&](std::uint32_t p, std::uint32_t n) { nodes[next[p]++] = n; });
    }
    std::span<const std::uint32_t> of(std::uint32_t patch) const {
        return std::span(nodes).subspan(first[patch], first[patch + 1] - first[patch]);
    }
};

bool hasNode(const Patch& patch, std::uint32_t n) {
    return patch.centreNode == n ||
           (patch.hasCornerNodes &&
            std::ranges::find(patch.cornerNodes, n) != patch.cornerNodes.end());
}

/// From patch to patch. \param found patches that light was found to get to, used up
void spread(const PatchSet& set, const Watchers& watchers, std::vector<std::uint32_t>& found,
            std::vector<std::uint8_t>& reachedNodes, std::vector<std::uint8_t>& reachedPatches) {
    const NodePatches patchesOf(set);
    while (!found.empty()) {
        const std::uint32_t next = found.back();
        found.pop_back();
        for (const std::uint32_t n : watchers.of(next)) {
            if (std::exchange(reachedNodes[n], std::uint8_t(1))) continue;
            for (const std::uint32_t whole : patchesOf.of(n))
                set.forEachPart(whole, [&](std::uint32_t p) {
                    if (hasNode(set.patches[p], n) && set.sends(p) &&
                        !std::exchange(reachedPatches[p], std::uint8_t(1)))
                        found.push_back(p);
                });
        }
    }
}

/// Fills in the bits of the nodes. \param reached 1: light gets there \pre the patches are known
void noteNodes(const PatchSet& set, const NodeHits& hits, std::span<const std::uint8_t> reached,
               Reach& reach) {
    reach.nodes.resize((reached.size() + 63) / 64);
    reach.enclosed.resize(reach.nodes.size());
    const auto isEnclosed = [&](std::size_t n) {
        return reached[n] != 0 && std::ranges::all_of(hits.hits(n), [&](std::uint32_t hit) {
                   const std::uint32_t p = patchMet(set, hit);
                   return p != Element::kNone && reach.patches[p] != 0;
               });
    };
    parallelFor(reach.nodes.size(), 16, [&](std::size_t first, std::size_t last) {
        for (std::size_t n = first * 64; n < std::min(last * 64, reached.size()); ++n) {
            reach.nodes[n / 64] |= std::uint64_t(reached[n]) << n % 64;
            reach.enclosed[n / 64] |= std::uint64_t(isEnclosed(n)) << n % 64;
        }
    });
}

} // namespace

Reach findReach(const PatchSet& set, const NodeHits& hits, std::span<const std::uint8_t> lit) {
    assert(hits.done());
    // Nodes that see a lit patch: most of those that can be reached.
    std::vector<std::uint8_t> reached(set.nodes.size());
    const auto counts = [&](std::size_t n) {
        return !isPadding(set.nodes[n]) && hits.isThere(set.nodeBlockObject[n / PatchSet::kBlock]);
    };
    parallelFor(reached.size(), 1024, [&](std::size_t first, std::size_t last) {
        for (std::size_t n = first; n < last; ++n)
            reached[n] = counts(n) && std::ranges::any_of(hits.hits(n), [&](std::uint32_t hit) {
                             const std::uint32_t p = patchMet(set, hit);
                             return p != Element::kNone && lit[p] != 0;
                         });
    });
    std::vector<std::uint32_t> others;
    for (std::uint32_t n = 0; n < reached.size(); ++n)
        if (!reached[n] && counts(n)) others.push_back(n);

    // The others: each is listed once, when light is found to get to it.
    Reach reach;
    reach.patches.assign(lit.begin(), lit.end());
    std::vector<std::uint32_t> found;
    for (std::uint32_t p = 0; p < set.patches.size(); ++p) {
        if (!set.sends(p)) {
            reach.patches[p] = 0;
            continue;
        }
        const Patch& patch = set.patches[p];
        const auto isReached = [&](std::uint32_t n) { return reached[n] != 0; };
        if (!isReached(patch.centreNode) &&
            !(patch.hasCornerNodes && std::ranges::any_of(patch.cornerNodes, isReached)))
            continue;
        if (!std::exchange(reach.patches[p], std::uint8_t(1))) found.push_back(p);
    }
    if (!found.empty() && !others.empty())
        spread(set, {set, hits, others}, found, reached, reach.patches);

    noteNodes(set, hits, reached, reach);
    return reach;
}

} // namespace penumbra
