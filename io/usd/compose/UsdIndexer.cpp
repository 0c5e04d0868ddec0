// Levels and tasks: an index grows from the root down to its prim; at each level all its nodes have
// their arcs evaluated.
#include "io/usd/compose/UsdIndexer.h"

#include <algorithm>

namespace penumbra {

namespace {

UsdNode rootNode(const UsdLayerStack& stack, UsdSitePath path) {
    UsdNode node;
    node.stack = &stack;
    node.path = path;
    node.toParent = std::make_shared<UsdMapping>(UsdMapping::identity(path.root()));
    node.hasSpecs = stack.hasSpec(path);
    return node;
}

// Whether the strongest opinion says that the prim's contents are shared with others.
bool isInstanceable(const UsdPrimIndex& index) {
    for (const std::uint32_t node : index.strengthOrder()) {
        const UsdNode& n = index[node];
        if (!n.speaks() || !n.hasSpecs) continue;
        const UsdValue* value = metadataAt(*n.stack, n.path, "instanceable");
        const auto numbers = value ? value->numbers() : std::vector<double>{};
        if (numbers.size() == 1) return numbers[0] != 0;
    }
    return false;
}

} // namespace

std::vector<bool> sharedNodes(const UsdPrimIndex& index) {
    if (index.nodes.size() == 1 || !isInstanceable(index)) return {};
    std::vector<bool> shared(index.nodes.size());
    bool any = false;
    for (const std::uint32_t node : index.subtree(0)) {
        const UsdNode& n = index[node];
        shared[node] = n.parent != kNoNode && (!n.ancestral || shared[n.parent]);
        any = any || (shared[node] && n.hasSpecs);
    }
    return any ? shared : std::vector<bool>{};
}

namespace {

// The parent's index one level down.
void advance(UsdPrimIndex& index, UsdSitePath path) {
    const std::vector<bool> shared = sharedNodes(index);
    for (std::uint32_t i = 0; i < index.nodes.size(); ++i) {
        UsdNode& node = index[i];
        node.path = i == 0 ? path : node.path.append(path);
        node.ancestral = i != 0;
        node.hasSpecs = node.stack->hasSpec(node.path);
        if (!shared.empty() && !shared[i]) index.silence(i);
    }
}

// Whether some layer says something about a kind of arc.
struct Written {
    bool references = false, payloads = false, inherits = false, specializes = false;
};
Written writtenAt(const UsdLayerStack& stack, UsdSitePath path) {
    Written written;
    for (const UsdStackedLayer& stacked : stack.layers) {
        const UsdPrimSpec* spec = stacked.index->spec(path);
        if (!spec || !spec->arcs) continue;
        written.references |= !spec->arcs->references.empty();
        written.payloads |= !spec->arcs->payloads.empty();
        written.inherits |= !spec->arcs->inherits.empty();
        written.specializes |= !spec->arcs->specializes.empty();
    }
    return written;
}

} // namespace

UsdPrimIndex UsdIndexer::root(const UsdLayerStack& stack) {
    UsdPrimIndex index;
    index.nodes.push_back(rootNode(stack, stacks_.paths().root()));
    return index;
}

UsdPrimIndex UsdIndexer::child(const UsdPrimIndex& parent, const std::string& name) {
    Graph graph;
    graph.asked = parent.path().child(name);
    graph.choosesVariants = true;
    errors_.setPrim(graph.asked.text());
    nodes_ = parent.nodes.size();
    full_ = false;
    allNodes_ += parent.nodes.size();
    if (allNodes_ <= limits_.allNodes)
        graph.index = parent;
    else // only what the scene's own layers say
        graph.index.nodes.push_back(rootNode(*parent[0].stack, parent.path()));
    advance(graph.index, graph.asked);
    level(graph, true);
    checkExpected(graph);
    return std::move(graph.index);
}

// The index of a site that an arc leads to, from its innermost variant down, or from the root.
UsdGraph UsdIndexer::build(const NewArc& arc, const Graph& waiting) {
    Graph graph;
    graph.asked = arc.path;
    graph.waiting = &waiting;
    graph.waitingParent = arc.parent;
    graph.arc = arc.arc;
    graph.mayRepeat = waiting.mayRepeat && arc.mayRepeat && !isClassArc(arc.arc);
    UsdSitePath base = arc.path;
    while (!base.isRoot() && !base.isChoice()) base = base.parent();
    graph.index.nodes.push_back(rootNode(*arc.stack, base));
    if (!base.isRoot()) level(graph, true);
    for (std::size_t length = base.length() + 1; length <= arc.path.length(); ++length) {
        graph.forgetSites();
        allNodes_ += graph.index.nodes.size();
        advance(graph.index, arc.path.prefix(length));
        level(graph, arc.speaks || length < arc.path.length());
    }
    return graph;
}

void UsdIndexer::level(Graph& graph, bool rootSpeaks) {
    if (!rootSpeaks) graph.index.silence(0);
    saltEarth(graph);
    for (const std::uint32_t node : graph.index.subtree(0)) {
        addTasks(graph, node);
        addVariantTasks(graph, node, false);
    }
    run(graph);
}

// Where something was relocated from nothing grows any more.
void UsdIndexer::saltEarth(Graph& graph) {
    UsdPrimIndex& index = graph.index;
    const auto source = std::find_if(index.nodes.begin(), index.nodes.end(), [](const UsdNode& n) {
        return n.speaks() && n.stack->relocates.isSource(n.path);
    });
    if (source == index.nodes.end()) return;
    if (graph.waiting)
        errors_.report({source->stack->rootLayer().file, 0, 0},
                       "an arc leads to <" + index.path().text() + ">, which is prohibited: <" +
                           source->path.text() + "> was relocated");
    for (std::uint32_t i = 0; i < index.nodes.size(); ++i) index.silence(i);
}

void UsdIndexer::addTasks(Graph& graph, std::uint32_t node) {
    const UsdNode& n = graph.index[node];
    if (n.arc == UsdArc::relocate && !n.ancestral) graph.push(UsdTaskKind::impliedRelocate, node);
    if (!n.speaks()) return;
    if (n.stack->relocates.sourceOf(n.path)) graph.push(UsdTaskKind::relocates, node);
    if (!n.hasSpecs) return;
    const Written written = writtenAt(*n.stack, n.path);
    if (written.references) graph.push(UsdTaskKind::references, node);
    if (written.payloads) graph.push(UsdTaskKind::payloads, node);
    if (written.inherits) graph.push(UsdTaskKind::inherits, node);
    if (written.specializes) graph.push(UsdTaskKind::specializes, node);
}

void UsdIndexer::run(Graph& graph) {
    do {
        for (std::size_t kind = 0; kind < kUsdTaskKinds; ++kind) {
            if (graph.tasks[kind].empty()) continue;
            evaluate(graph, UsdTaskKind(kind), graph.pop(UsdTaskKind(kind)));
            kind = std::size_t(-1); // it may have added tasks of lower kinds
        }
    } while (chooseVariant(graph));
}

void UsdIndexer::evaluate(Graph& graph, UsdTaskKind kind, std::uint32_t node) {
    const bool always = kind == UsdTaskKind::impliedRelocate || kind == UsdTaskKind::impliedClasses;
    if (!always && !graph.index[node].speaks()) return;
    switch (kind) {
    case UsdTaskKind::relocates:
        return evaluateRelocates(graph, node);
    case UsdTaskKind::impliedRelocate:
        return evaluateImpliedRelocate(graph, node);
    case UsdTaskKind::references:
        return evaluateReferences(graph, node, UsdReferenceKind::reference);
    case UsdTaskKind::payloads:
        return evaluateReferences(graph, node, UsdReferenceKind::payload);
    case UsdTaskKind::inherits:
        return evaluateClasses(graph, node, UsdClassKind::inherit);
    case UsdTaskKind::specializes:
        return evaluateClasses(graph, node, UsdClassKind::specialize);
    case UsdTaskKind::impliedClasses:
        return evaluateImpliedClasses(graph, node);
    }
}

void UsdIndexer::checkExpected(const Graph& graph) {
    for (const UsdExpectedPrim& one : graph.expected)
        if (!graph.index.anySpecs(one.node)) errors_.report(one.where, one.problem);
}

// Whether there may be that many more nodes.
bool UsdIndexer::spend(std::size_t nodes, const UsdPrimIndex& index) {
    const SourceLocation where{index[0].stack->rootLayer().file, 0, 0};
    nodes_ += nodes;
    allNodes_ += nodes;
    if (nodes_ > limits_.nodes && !full_) {
        errors_.report(where, "too many arcs: those beyond " + std::to_string(limits_.nodes) +
                                  " are left out");
        full_ = true;
    }
    if (allNodes_ > limits_.allNodes && !allFull_) {
        errors_.report(where, "the scene has too many arcs: further ones are left out");
        allFull_ = true;
    }
    return nodes_ <= limits_.nodes && allNodes_ <= limits_.allNodes;
}

} // namespace penumbra
