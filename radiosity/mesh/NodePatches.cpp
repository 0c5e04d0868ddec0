#include "radiosity/mesh/NodePatches.h"

#include <algorithm>
#include <functional>
#include <numeric>

namespace penumbra {

NodePatches::NodePatches(const PatchSet& set)
    : set_(&set), first_(1 + (set.parts.used.empty() ? set.nodes.size() : set.parts.firstNode)) {
    if (set.nodes.empty()) return;
    add({0, std::uint32_t(set.parts.cornerNodes.size())}, {0, std::uint32_t(first_.size() - 1)});
}

void NodePatches::add(Range patches, Range nodes) {
    if (nodes.count == 0) return; // of nothing: they lie nowhere
    const PatchSet& set = *set_;
    const auto forEachNode = [&](auto visit) {
        for (std::uint32_t p = patches.first; p < patches.end(); ++p) {
            if (set.patches[p].elementCount == 0) continue; // there may be one later
            visit(set.patches[p].centreNode, p);
            if (set.patches[p].hasCornerNodes)
                for (std::uint32_t node : set.parts.cornerNodes[p]) visit(node, p);
        }
    };
    const auto from = first_.begin() + nodes.first, to = first_.begin() + nodes.end() + 1;
    std::vector<std::uint32_t> next(nodes.count);
    forEachNode([&](std::uint32_t n, std::uint32_t) { ++next[n - nodes.first]; });
    std::inclusive_scan(next.begin(), next.end(), from + 1, std::plus(), *from);
    std::fill(to, first_.end(), *(to - 1));
    patches_.resize(first_.back());
    std::copy(from, to - 1, next.begin());
    forEachNode([&](std::uint32_t n, std::uint32_t p) { patches_[next[n - nodes.first]++] = p; });
}

} // namespace penumbra
