// Choosing variants: last of all, since any arc may bring a selection.
#include "io/usd/compose/UsdIndexer.h"

#include <algorithm>
#include <tuple>
#include <unordered_map>

namespace penumbra {

namespace {

using Phase = UsdVariantTask::Phase;

// Sets that nobody chooses for have this variant, if there is one.
constexpr std::string_view kFallbackSet = "standin";
constexpr std::string_view kFallbackChoice = "render";

constexpr std::size_t kComparisonsPerNode = 64; // cost as much as a node

// Whether `node` could speak when its path was that of `site`.
bool spokeAt(const UsdNode& node, UsdSitePath site) {
    if (node.speaks()) return true;
    return !node.cut && node.bar > site.length();
}

// Whether the node hangs at or below a class arc that was made for this very prim.
bool isBelowOwnClass(const UsdPrimIndex& index, std::uint32_t node) {
    for (; node != kNoNode; node = index[node].parent)
        if (isClassArc(index[node].arc) && !index[node].ancestral) return true;
    return false;
}

// Where in `path` the prim `plain` is spoken of: with the choices that follow it.
UsdSitePath siteWithin(UsdSitePath path, UsdSitePath plain) {
    for (UsdSitePath at = path; at && at.levels() >= plain.levels(); at = at.parent())
        if (at.plain() == plain) return at;
    return plain;
}

// The path of a prim in other nodes: carried up as far as it maps, and down again from there.
class PathsDown {
public:
    PathsDown(const UsdPrimIndex& index, const UsdVariantTask& task) : index_(index) {
        std::uint32_t top = task.node;
        UsdSitePath path = task.site.plain();
        while (index[top].parent != kNoNode) {
            const UsdSitePath above = index[top].toParent->map(path);
            if (!above) break;
            path = above;
            top = index[top].parent;
        }
        known_[top] = path;
    }

    /// Empty if it doesn't map.
    UsdSitePath at(std::uint32_t node) {
        std::vector<std::uint32_t> down;
        auto found = known_.find(node);
        while (found == known_.end()) {
            down.push_back(node);
            node = index_[node].parent;
            if (node == kNoNode) break;
            found = known_.find(node);
        }
        UsdSitePath path = node == kNoNode ? UsdSitePath() : found->second;
        for (std::size_t i = down.size(); i-- > 0;) {
            if (path) path = index_[down[i]].toParent->mapBack(path);
            known_[down[i]] = path;
        }
        return path;
    }

private:
    const UsdPrimIndex& index_;
    std::unordered_map<std::uint32_t, UsdSitePath> known_;
};

} // namespace

// For a new node also the sets of its site's ancestors: they were not chosen for yet.
void UsdIndexer::addVariantTasks(Graph& graph, std::uint32_t node, bool isNew) {
    if (!graph.choosesVariants) return;
    const UsdNode& n = graph.index[node];
    for (UsdSitePath site = n.path; !site.isRoot(); site = site.parent()) {
        const bool ancestral = site != n.path;
        if (ancestral && !isNew) break;
        if (spokeAt(n, site)) {
            const auto sets = variantSetsAt(*n.stack, site);
            for (std::uint32_t i = 0; i < sets.size(); ++i) {
                if (graph.variants.tasks.size() >= limits_.variantSets) {
                    spend(limits_.nodes, graph.index); // says so
                    return;
                }
                graph.variants.tasks.push_back({node, site, sets[i], i, ancestral});
                graph.variants.sorted = false;
            }
        }
        if (site.isChoice()) break; // what is above has the node that this one hangs from
    }
}

void UsdIndexer::sortVariants(Graph& graph) {
    UsdVariantQueue& queue = graph.variants;
    const auto& ranks = graph.ranks();
    queue.order.resize(queue.tasks.size());
    for (std::size_t i = 0; i < queue.order.size(); ++i) queue.order[i] = i;
    const auto key = [&](std::size_t i) {
        const UsdVariantTask& task = queue.tasks[i];
        return std::tuple(ranks[task.node], task.site.length(), task.number);
    };
    std::sort(queue.order.begin(), queue.order.end(),
              [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
    queue.next = {};
    queue.sorted = true;
    spend(graph.index.nodes.size() / kComparisonsPerNode, graph.index);
}

bool UsdIndexer::chooseVariant(Graph& graph) {
    UsdVariantQueue& queue = graph.variants;
    if (queue.tasks.empty()) return false;
    if (!queue.sorted) sortVariants(graph);
    for (const bool ancestral : {true, false})
        for (const Phase phase : {Phase::authored, Phase::fallback}) {
            std::size_t& at = queue.next[ancestral ? 0 : 1][std::size_t(phase)];
            for (; at < queue.order.size(); ++at) {
                const UsdVariantTask& task = queue.tasks[queue.order[at]];
                if (task.ancestral != ancestral || task.phase != phase) continue;
                evaluateVariant(graph, queue.order[at]);
                return true;
            }
        }
    return false;
}

void UsdIndexer::evaluateVariant(Graph& graph, std::size_t number) {
    UsdVariantTask& task = graph.variants.tasks[number];
    const UsdNode& n = graph.index[task.node];
    if (!spokeAt(n, task.site)) {
        task.phase = Phase::done;
        return;
    }
    auto choice = selection(graph, task);
    task.seen = graph.index.nodes.size();
    const bool hasFallback = task.set == kFallbackSet && task.phase == Phase::fallback &&
                             n.stack->hasSpec(task.site.withChoice(task.set, kFallbackChoice));
    if (!choice && hasFallback) choice = kFallbackChoice;
    if (choice) {
        task.phase = Phase::done;
        if (!choice->empty()) addVariant(graph, UsdVariantTask(task), *choice);
    } else {
        task.phase = task.phase == Phase::authored ? Phase::fallback : Phase::waiting;
    }
}

void UsdIndexer::addVariant(Graph& graph, const UsdVariantTask& task, const std::string& choice) {
    const UsdNode& n = graph.index[task.node];
    NewArc arc;
    arc.arc = UsdArc::variant;
    arc.parent = arc.origin = task.node;
    arc.stack = n.stack;
    arc.path = n.path.replacePrefix(task.site, task.site.withChoice(task.set, choice));
    arc.mapping = identity_;
    arc.sibling = task.number;
    arc.depth = task.site.levels();
    arc.ancestralOpinions = task.ancestral;
    arc.mayRepeat = !(task.ancestral && isBelowOwnClass(graph.index, task.node));
    arc.mayCycle = true;
    arc.where = locationAt(*n.stack, task.site);
    addArc(graph, arc);
    for (UsdVariantTask& other : graph.variants.tasks) // it may bring selections
        if (other.phase != Phase::done) other.phase = Phase::authored;
    graph.variants.sorted = false;
}

// What is chosen for a set: a choice that was made already, else the strongest that is written.
// Nodes that were searched before have none.
std::optional<std::string> UsdIndexer::selection(const Graph& graph, const UsdVariantTask& task) {
    const UsdPrimIndex& index = graph.index;
    const std::size_t unseen = index.nodes.size() - task.seen;
    if (!spend(unseen / kComparisonsPerNode, index)) return std::nullopt;
    PathsDown paths(index, task);
    std::vector<std::uint32_t> nodes(unseen);
    for (std::size_t i = 0; i < unseen; ++i) nodes[i] = std::uint32_t(task.seen + i);
    const auto& ranks = graph.ranks();
    std::sort(nodes.begin(), nodes.end(),
              [&](std::uint32_t a, std::uint32_t b) { return ranks[a] < ranks[b]; });
    for (const std::uint32_t node : nodes) {
        if (index[node].arc != UsdArc::variant) continue;
        const UsdSitePath prim = paths.at(node);
        const UsdSitePath made = index.pathAtIntroduction(node);
        for (UsdSitePath at = made; prim && at && at.isChoice(); at = at.parent())
            if (at.name() == task.set && at.plain() == prim) return at.choice();
    }
    for (const std::uint32_t node : nodes) {
        const UsdSitePath prim = paths.at(node);
        if (!prim) continue;
        const UsdSitePath site = siteWithin(index[node].path, prim);
        if (!spokeAt(index[node], site)) continue;
        if (auto found = variantSelectionAt(*index[node].stack, site, task.set, errors_))
            return found;
    }
    return std::nullopt;
}

} // namespace penumbra
