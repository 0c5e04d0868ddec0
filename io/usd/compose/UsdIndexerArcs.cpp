// Adding an arc to a graph.
#include "io/usd/compose/UsdIndexer.h"

#include <algorithm>

namespace penumbra {

bool UsdIndexer::mayAdd(const Graph& graph, const NewArc& arc) {
    const auto refuse = [&](const std::string& why) {
        errors_.report(arc.where, std::string(nameOf(arc.arc)) + " of <" + arc.path.text() +
                                      "> left out: " + why);
        return false;
    };
    if (graph.arcDepth(arc.parent) >= limits_.arcDepth) return refuse("arcs are nested too deeply");
    if (!arc.mayCycle && graph.isCycle(arc.parent, arc.stack, arc.path))
        return refuse("it leads in a circle");
    const bool mayRepeat = graph.mayRepeat && arc.mayRepeat && !isClassArc(arc.arc);
    if (!mayRepeat && arc.speaks && graph.speaksAlready(arc.stack, arc.path)) return false;
    constexpr std::size_t kPerNode =
        16; // pairs of a mapping, and layers of a stack, cost as a node
    const std::size_t more = arc.mapping->pairs().size() + arc.stack->layers.size();
    return spend(1 + more / kPerNode, graph.index);
}

std::uint32_t UsdIndexer::addArc(Graph& graph, const NewArc& arc) {
    if (!mayAdd(graph, arc)) return kNoNode;
    if (arc.ancestralOpinions && arc.path.length() > 1) return hang(graph, arc, build(arc, graph));
    Graph alone;
    UsdNode& node = alone.index.nodes.emplace_back();
    node.stack = arc.stack;
    node.path = arc.path;
    node.hasSpecs = arc.stack->hasSpec(arc.path);
    if (!arc.speaks) {
        node.silent = true;
        node.bar = 1;
    }
    const std::uint32_t made = hang(graph, arc, std::move(alone));
    addTasks(graph, made);
    return made;
}

std::uint32_t UsdIndexer::hang(Graph& graph, const NewArc& arc, Graph made) {
    auto& nodes = graph.index.nodes;
    const auto first = std::uint32_t(nodes.size());
    const auto moved = [first](std::uint32_t& node) {
        if (node != kNoNode) node += first;
    };
    for (UsdExpectedPrim& one : made.expected) {
        moved(one.node);
        graph.expected.push_back(std::move(one));
    }
    for (UsdNode& node : made.index.nodes) {
        moved(node.parent);
        moved(node.origin);
        for (std::uint32_t& child : node.children) moved(child);
        node.toRoot = nullptr;
        nodes.push_back(std::move(node));
    }
    UsdNode& root = nodes[first];
    root.arc = arc.arc;
    root.parent = arc.parent;
    root.origin = arc.origin;
    root.toParent = arc.mapping;
    root.sibling = arc.sibling;
    root.depth = std::uint32_t(arc.depth);
    root.ancestral = false;
    graph.index.place(first);
    for (std::uint32_t node = first; node < nodes.size(); ++node)
        addVariantTasks(graph, node, true);
    queueImplied(graph, first);
    return first;
}

// The place where a chain of classes begins is where it must be implied further.
void UsdIndexer::queueImplied(Graph& graph, std::uint32_t node) {
    const UsdPrimIndex& index = graph.index;
    const auto& children = index[node].children;
    if (std::any_of(children.begin(), children.end(),
                    [&](std::uint32_t child) { return isClassArc(index[child].arc); }))
        graph.push(UsdTaskKind::impliedClasses, node);
    if (!isClassArc(index[node].arc)) return;
    while (isClassArc(index[node].arc)) {
        const std::size_t below = index.below(node);
        std::uint32_t first = node;
        while (isClassArc(index[node].arc) && index.below(node) == below) {
            first = node;
            node = index[node].parent;
        }
        if (index.pathAtIntroduction(first).hasPrefix(index.pathAtIntroduction(node))) break;
    }
    graph.push(UsdTaskKind::impliedClasses, node);
}

} // namespace penumbra
