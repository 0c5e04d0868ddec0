#include "io/usd/compose/UsdGraph.h"

namespace penumbra {

bool UsdGraph::isCycle(std::uint32_t parent, const UsdLayerStack* stack, UsdSitePath path) const {
    for (const UsdGraph* graph = this; graph; graph = graph->waiting) {
        for (std::uint32_t n = parent; n != kNoNode; n = graph->index[n].parent) {
            const UsdNode& node = graph->index[n];
            const bool waitingRoot = n == 0 && graph != this;
            const UsdSitePath other = waitingRoot ? graph->asked : node.path;
            if (node.stack == stack && (path.hasPrefix(other) || other.hasPrefix(path)))
                return true;
        }
        parent = graph->waitingParent;
    }
    return false;
}

bool UsdGraph::speaks(const UsdLayerStack* stack, UsdSitePath path) const {
    for (; known_ < index.nodes.size(); ++known_)
        sites_.emplace(index.nodes[known_].path, std::uint32_t(known_));
    const auto [begin, end] = sites_.equal_range(path);
    for (auto at = begin; at != end; ++at) {
        const UsdNode& node = index[at->second];
        if (node.stack == stack && node.path == path && node.speaks()) return true;
    }
    return false;
}

// A waiting graph may be at another level than this one: what this one still has to append is
// appended to the path.
bool UsdGraph::speaksAlready(const UsdLayerStack* stack, UsdSitePath path) const {
    for (const UsdGraph* graph = this; graph; graph = graph->waiting) {
        if (graph->speaks(stack, path)) return true;
        path = graph->asked.replacePrefix(graph->index.path(), path);
    }
    return false;
}

std::size_t UsdGraph::arcDepth(std::uint32_t node) const {
    std::size_t depth = 0;
    for (const UsdGraph* graph = this; graph; graph = graph->waiting) {
        for (std::uint32_t n = node; n != kNoNode; n = graph->index[n].parent) ++depth;
        node = graph->waitingParent;
    }
    return depth;
}

const std::vector<std::uint32_t>& UsdGraph::ranks() const {
    if (ranks_.size() == index.nodes.size()) return ranks_;
    ranks_.resize(index.nodes.size());
    const auto order = index.strengthOrder();
    for (std::size_t i = 0; i < order.size(); ++i) ranks_[order[i]] = std::uint32_t(i);
    return ranks_;
}

UsdSitePath withChoicesOf(UsdSitePath path, UsdSitePath result) {
    for (; !path.isRoot(); path = path.parent())
        if (path.isChoice() && result.hasPrefix(path.plain()))
            return result.replacePrefix(path.plain(), path);
    return result;
}

} // namespace penumbra
