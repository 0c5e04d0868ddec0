#include "radiosity/mesh/NodePatches.h"

#include <numeric>

namespace penumbra {

NodePatches::NodePatches(const PatchSet& set) : first_(set.nodes.size() + 1) {
    if (set.nodes.empty()) return;
    const auto forEachNode = [&](auto visit) {
        for (std::uint32_t p = 0; p < set.patches.size(); ++p) {
            const Patch& patch = set.patches[p];
            visit(patch.centreNode, p);
            if (patch.hasCornerNodes)
                for (std::uint32_t node : patch.cornerNodes) visit(node, p);
        }
    };
    forEachNode([&](std::uint32_t n, std::uint32_t) { ++first_[n + 1]; });
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    patches_.resize(first_.back());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    forEachNode([&](std::uint32_t n, std::uint32_t p) { patches_[next[n]++] = p; });
}

} // namespace penumbra
