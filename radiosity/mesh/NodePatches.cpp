#include "radiosity/mesh/NodePatches.h"

#include <numeric>

namespace penumbra {

NodePatches::NodePatches(const PatchSet& set)
    : set_(&set), first_(1 + (set.parts.used.empty() ? set.nodes.size() : set.parts.firstNode)) {
    if (set.nodes.empty()) return;
    const auto forEachNode = [&](auto visit) {
        for (std::uint32_t p = 0; p < set.parts.cornerNodes.size(); ++p) {
            visit(set.patches[p].centreNode, p);
            if (set.patches[p].hasCornerNodes)
                for (std::uint32_t node : set.parts.cornerNodes[p]) visit(node, p);
        }
    };
    forEachNode([&](std::uint32_t n, std::uint32_t) { ++first_[n + 1]; });
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    patches_.resize(first_.back());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    forEachNode([&](std::uint32_t n, std::uint32_t p) { patches_[next[n]++] = p; });
}

} // namespace penumbra
