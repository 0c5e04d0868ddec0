// Makes prim indices: evaluates the arcs of a prim until there are no more.
#pragma once

#include "io/usd/compose/UsdGraph.h"
#include "io/usd/compose/UsdLayerStacks.h"

#include <string>
#include <unordered_map>

namespace penumbra {

/// Bounds against hostile scenes. What exceeds them is reported once and left out.
struct UsdIndexLimits {
    std::size_t arcDepth = 64;         ///< arcs below each other, waiting graphs counted
    std::size_t nodes = 100'000;       ///< of an index
    std::size_t allNodes = 50'000'000; ///< of all indices together
    std::size_t variantSets = 10'000;  ///< of an index
};

/// Composes prim by prim: a prim's index grows out of its parent's. The order of strength is the
/// AOUSD core specification's (LIVERPS), the details are OpenUSD's.
class UsdIndexer {
public:
    UsdIndexer(UsdLayerStacks& stacks, UsdCompositionErrors& errors,
               const UsdIndexLimits& limits = {})
        : stacks_(stacks), errors_(errors), limits_(limits),
          identity_(std::make_shared<UsdMapping>(UsdMapping::identity(stacks.paths().root()))) {}

    /// The index of `/`.
    UsdPrimIndex root(const UsdLayerStack& stack);
    /// The index of a child of a composed prim.
    UsdPrimIndex child(const UsdPrimIndex& parent, const std::string& name);

private:
    using Graph = UsdGraph;

    /// An arc that is to be added.
    struct NewArc {
        UsdArc arc = UsdArc::reference;
        std::uint32_t parent = 0;
        std::uint32_t origin = 0;
        const UsdLayerStack* stack = nullptr;
        UsdSitePath path;
        UsdMappingPtr mapping;
        std::uint32_t sibling = 0;
        std::size_t depth = 0;
        bool speaks = true;
        bool ancestralOpinions = false; ///< the site's own index is hung here, not only the site
        bool mayRepeat = true;          ///< a speaking node of that site may exist
        bool mayCycle = false;
        SourceLocation where;
    };

    // UsdIndexer.cpp: levels and tasks.
    Graph build(const NewArc& arc, const Graph& waiting);
    void level(Graph& graph, bool rootSpeaks);
    void saltEarth(Graph& graph);
    void addTasks(Graph& graph, std::uint32_t node);
    void run(Graph& graph);
    void checkExpected(const Graph& graph);
    void evaluate(Graph& graph, UsdTaskKind kind, std::uint32_t node);
    bool spend(std::size_t nodes, const UsdPrimIndex& index);

    // UsdIndexerArcs.cpp: adding an arc.
    std::uint32_t addArc(Graph& graph, const NewArc& arc);
    bool mayAdd(const Graph& graph, const NewArc& arc);
    std::uint32_t hang(Graph& graph, const NewArc& arc, Graph made);
    void queueImplied(Graph& graph, std::uint32_t node);

    // UsdIndexerKinds.cpp: relocates, references, payloads, inherits and specializes.
    void evaluateRelocates(Graph& graph, std::uint32_t node);
    void evaluateImpliedRelocate(Graph& graph, std::uint32_t node);
    void evaluateReferences(Graph& graph, std::uint32_t node, UsdReferenceKind kind);
    void addReference(Graph& graph, std::uint32_t node, const UsdSiteReference& reference,
                      UsdArc kind, std::uint32_t sibling);
    void evaluateClasses(Graph& graph, std::uint32_t node, UsdClassKind kind);
    UsdMappingPtr arcMapping(const UsdLayerStack& stack, UsdSitePath site, UsdSitePath target,
                             const UsdLayerOffset& offset, bool rooted);

    // UsdImpliedClasses.cpp
    struct Transfer;
    void evaluateImpliedClasses(Graph& graph, std::uint32_t node);
    std::uint32_t impliedClass(Graph& graph, const Transfer& transfer, std::uint32_t child,
                               const UsdMappingPtr& mapping);

    // UsdVariants.cpp
    void addVariantTasks(Graph& graph, std::uint32_t node, bool isNew);
    bool chooseVariant(Graph& graph);
    void evaluateVariant(Graph& graph, std::size_t number);
    void addVariant(Graph& graph, const UsdVariantTask& task, const std::string& choice);
    void sortVariants(Graph& graph);
    std::optional<std::string> selection(const Graph& graph, const UsdVariantTask& task);

    UsdLayerStacks& stacks_;
    UsdCompositionErrors& errors_;
    UsdIndexLimits limits_;
    UsdMappingPtr identity_;
    /// Mappings of arcs where something is relocated, by the path of what has the arc: a prim's
    /// arcs are evaluated again for each of its children that was relocated.
    struct KnownMapping {
        const UsdLayerStack* stack;
        UsdSitePath target;
        UsdLayerOffset offset;
        bool rooted;
        UsdMappingPtr mapping;
    };
    std::unordered_multimap<UsdSitePath, KnownMapping> mappings_;
    std::size_t knownPairs_ = 0;

    std::size_t nodes_ = 0;    // of the outermost index
    std::size_t allNodes_ = 0; // of all
    bool full_ = false;        // said so for this index
    bool allFull_ = false;
};

} // namespace penumbra
