// Relocates, references, payloads, inherits and specializes of one node.
#include "io/usd/compose/UsdIndexer.h"

#include <algorithm>

namespace penumbra {

namespace {

// The prim that is meant where none is named; empty if there is none.
UsdSitePath defaultPrim(const UsdLayerStack& stack, UsdSitePath anyPath) {
    const UsdValue* value = find(stack.rootLayer().metadata, "defaultPrim");
    const std::string* name = value ? value->text() : nullptr;
    if (!name || name->empty()) return {};
    const UsdSitePath path = anyPath.fromText(name->front() == '/' ? *name : "/" + *name);
    return path && !path.isRoot() ? path : UsdSitePath();
}

} // namespace

// What was relocated here: opinions at the source's ancestors count, those at the source do not.
void UsdIndexer::evaluateRelocates(Graph& graph, std::uint32_t node) {
    UsdPrimIndex& index = graph.index;
    const UsdLayerStack& stack = *index[node].stack;
    NewArc arc;
    arc.arc = UsdArc::relocate;
    arc.parent = arc.origin = node;
    arc.stack = &stack;
    arc.path = stack.relocates.sourceOf(index[node].path);
    arc.mapping = identity_;
    arc.depth = index[node].path.levels();
    arc.speaks = false;
    arc.ancestralOpinions = true;
    arc.where = {stack.rootLayer().file, 0, 0};
    for (const std::uint32_t child : index[node].children)
        if (index[child].arc != UsdArc::variant) index.cut(child);
    const std::uint32_t made = addArc(graph, arc);
    if (made == kNoNode) return;
    for (const UsdStackedLayer& stacked : stack.layers)
        if (const UsdPrimSpec* spec = stacked.index->spec(arc.path))
            errors_.report(stacked.layer->location(spec->where),
                           "opinion about <" + arc.path.text() +
                               "> ignored: it was relocated from there");
    for (const std::uint32_t below : index.subtree(made))
        if (index[below].speaks() && index[below].stack->relocates.isSource(index[below].path))
            index.cut(below);
}

// A relocate below an arc is one of what has the arc, too.
void UsdIndexer::evaluateImpliedRelocate(Graph& graph, std::uint32_t node) {
    const UsdPrimIndex& index = graph.index;
    const UsdNode& parent = index[index[node].parent];
    if (parent.parent == kNoNode) return;
    const UsdNode& grandparent = index[parent.parent];
    const UsdSitePath path = parent.toParent->map(index[node].path.plain());
    if (!path) return;
    for (const std::uint32_t child : grandparent.children)
        if (index[child].arc == UsdArc::relocate && index[child].path == path) return;
    NewArc arc;
    arc.arc = UsdArc::relocate;
    arc.parent = parent.parent;
    arc.origin = node;
    arc.stack = grandparent.stack;
    arc.path = path;
    arc.mapping = identity_;
    arc.depth = grandparent.path.levels();
    arc.speaks = false;
    arc.where = {grandparent.stack->rootLayer().file, 0, 0};
    addArc(graph, arc);
}

// From what an arc brings to the site that has it, with what its stack relocates applied last.
UsdMappingPtr UsdIndexer::arcMapping(const UsdLayerStack& stack, UsdSitePath site,
                                     UsdSitePath target, const UsdLayerOffset& offset,
                                     bool rooted) {
    const UsdSitePath path = site.plain();
    UsdMapping mapping({{target, path}}, offset);
    if (rooted) mapping = mapping.rooted();
    if (stack.relocates.empty()) return std::make_shared<UsdMapping>(std::move(mapping));
    const auto [begin, end] = mappings_.equal_range(path);
    for (auto at = begin; at != end; ++at) {
        const KnownMapping& known = at->second;
        if (known.stack == &stack && known.target == target && known.rooted == rooted &&
            known.offset.offset == offset.offset && known.offset.scale == offset.scale)
            return known.mapping;
    }
    auto made = std::make_shared<UsdMapping>(stack.relocates.mappingAt(path).after(mapping));
    if (rooted) *made = made->rooted();
    constexpr std::size_t kMostPairs = 1'000'000;
    knownPairs_ += made->pairs().size();
    if (knownPairs_ > kMostPairs) {
        mappings_.clear();
        knownPairs_ = made->pairs().size();
    }
    mappings_.emplace(path, KnownMapping{&stack, target, offset, rooted, made});
    return made;
}

void UsdIndexer::evaluateReferences(Graph& graph, std::uint32_t node, UsdReferenceKind kind) {
    const UsdNode& n = graph.index[node];
    const auto references = referencesAt(*n.stack, n.path, kind, errors_);
    const UsdArc arc = kind == UsdReferenceKind::payload ? UsdArc::payload : UsdArc::reference;
    for (std::size_t i = 0; i < references.size(); ++i)
        addReference(graph, node, references[i], arc, std::uint32_t(i));
}

void UsdIndexer::addReference(Graph& graph, std::uint32_t node, const UsdSiteReference& reference,
                              UsdArc kind, std::uint32_t sibling) {
    const UsdLayerStack& stack = *graph.index[node].stack;
    const UsdSitePath path = graph.index[node].path;
    const auto said = [&](const std::string& why) {
        return std::string(nameOf(kind)) + " @" + reference.asset + "@<" + reference.path +
               "> of <" + path.text() + "> left out: " + why;
    };
    const auto report = [&](const std::string& why) { errors_.report(reference.where, said(why)); };
    NewArc arc;
    arc.stack = &stack;
    std::string problem;
    if (!reference.file.empty())
        arc.stack = reference.asset.find("://") != std::string::npos
                        ? nullptr
                        : stacks_.find(reference.file, stack.variables, problem);
    if (!arc.stack) return report(problem.empty() ? "only files can be read" : problem);
    arc.arc = kind;
    arc.parent = arc.origin = node;
    arc.path =
        reference.path.empty() ? defaultPrim(*arc.stack, path) : path.fromText(reference.path);
    if (!arc.path) {
        report(reference.path.empty() ? "there is no default prim" : "not the path of a prim");
        if (!reference.path.empty()) return;
        arc.path = path.root();
        arc.speaks = false;
    }
    const bool missing = arc.path.isRoot();
    UsdLayerOffset offset = reference.offset;
    offset.scale *= reference.timeCodes / arc.stack->timeCodesPerSecond;
    arc.mapping = arcMapping(stack, path, arc.path, offset, reference.file.empty());
    arc.sibling = sibling;
    arc.depth = path.levels();
    arc.ancestralOpinions = arc.path.length() > 1;
    arc.where = reference.where;
    const std::uint32_t made = addArc(graph, arc);
    if (made != kNoNode && !missing && !graph.index.anySpecs(made))
        graph.expected.push_back({made, reference.where, said("there is no prim")});
}

void UsdIndexer::evaluateClasses(Graph& graph, std::uint32_t node, UsdClassKind kind) {
    const UsdLayerStack& stack = *graph.index[node].stack;
    const UsdSitePath path = graph.index[node].path;
    const auto classes = classesAt(stack, path, kind, errors_);
    for (std::size_t i = 0; i < classes.size(); ++i) {
        NewArc arc;
        arc.arc = kind == UsdClassKind::inherit ? UsdArc::inherit : UsdArc::specialize;
        arc.parent = arc.origin = node;
        arc.stack = &stack;
        arc.mapping = arcMapping(stack, path, classes[i], {}, true);
        arc.path = arc.mapping->mapBack(path.plain());
        if (!arc.path) continue;
        arc.path = withChoicesOf(path, arc.path);
        arc.sibling = std::uint32_t(i);
        arc.depth = path.levels();
        arc.ancestralOpinions = true;
        arc.where = locationAt(stack, path);
        addArc(graph, arc);
    }
}

} // namespace penumbra
