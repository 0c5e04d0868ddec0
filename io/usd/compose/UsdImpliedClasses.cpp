// A class that works below a prim works also where that prim was brought to.
#include "io/usd/compose/UsdIndexer.h"

#include <algorithm>

namespace penumbra {

/// Class children of `from` are to be implied in `to`.
struct UsdIndexer::Transfer {
    std::uint32_t to = 0;
    std::uint32_t from = 0;
    UsdMapping mapping; ///< of the paths of `from` to those of `to`
    bool first = false; ///< the children hang right below where the arc to `to` begins
};

void UsdIndexer::evaluateImpliedClasses(Graph& graph, std::uint32_t node) {
    UsdPrimIndex& index = graph.index;
    if (index[node].parent == kNoNode) return;
    std::vector<Transfer> open;
    Transfer start{index[node].parent, node, index[node].toParent->rooted(), true};
    while (index[start.to].arc == UsdArc::relocate) { // to what it was relocated to
        graph.push(UsdTaskKind::impliedClasses, start.to);
        start.mapping = index[start.to].toParent->rooted().after(start.mapping);
        start.to = index[start.to].parent;
    }
    open.push_back(std::move(start));
    while (!open.empty()) {
        const Transfer transfer = std::move(open.back());
        open.pop_back();
        std::vector<Transfer> next;
        const auto children = index[transfer.from].children;
        for (const std::uint32_t child : children) {
            if (!isClassArc(index[child].arc)) continue;
            const bool chain = transfer.first && isClassArc(index[transfer.from].arc) &&
                               index.below(child) == index.below(transfer.from);
            if (chain) continue; // it goes on, and is implied from where it begins
            const UsdMapping through = transfer.mapping.after(*index[child].toParent);
            const auto mapping =
                std::make_shared<UsdMapping>(through.after(transfer.mapping.inverse()).rooted());
            const std::uint32_t implied = impliedClass(graph, transfer, child, mapping);
            if (implied != kNoNode)
                next.push_back({implied, child, mapping->inverse().after(through), false});
        }
        open.insert(open.end(), std::make_move_iterator(next.rbegin()),
                    std::make_move_iterator(next.rend()));
    }
}

// The class `child` in `transfer.to`: found there, or added.
std::uint32_t UsdIndexer::impliedClass(Graph& graph, const Transfer& transfer, std::uint32_t child,
                                       const UsdMappingPtr& mapping) {
    UsdPrimIndex& index = graph.index;
    const UsdNode& to = index[transfer.to];
    UsdSitePath path = mapping->mapBack(to.path.plain());
    if (!path) return kNoNode;
    path = withChoicesOf(to.path, path);
    const bool relocate = graph.isRelocate(transfer.to);
    const auto isSame = [&](const UsdNode& there) {
        if (!relocate) return there.stack == to.stack && there.path == path;
        return there.arc == index[child].arc && *there.toParent == *mapping &&
               index.below(there.origin) == index.below(child);
    };
    for (const std::uint32_t there : to.children) {
        if (!isSame(index[there])) continue;
        if (index.isBefore(child, index[there].origin)) {
            index[there].origin = child;
            index.placeAgain(there);
            graph.forgetRanks();
        }
        return there;
    }
    NewArc arc;
    arc.arc = index[child].arc;
    arc.parent = transfer.to;
    arc.origin = child;
    arc.stack = to.stack;
    arc.path = path;
    arc.mapping = mapping;
    arc.sibling = index[child].sibling;
    arc.depth = to.path.levels();
    const bool sameAsChild = to.stack == index[child].stack && path == index[child].path;
    arc.speaks = path != to.path && !sameAsChild && !relocate;
    arc.ancestralOpinions = arc.speaks;
    arc.mayCycle = path == to.path || relocate;
    arc.where = locationAt(*to.stack, to.path);
    return addArc(graph, arc);
}

} // namespace penumbra
