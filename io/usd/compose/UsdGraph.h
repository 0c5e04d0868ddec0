// A prim index that is being made.
#pragma once

#include "io/usd/compose/UsdPrimIndex.h"
#include "io/usd/compose/UsdSiteArcs.h"

#include <array>
#include <cstdint>
#include <deque>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace penumbra {

/// What is done about a node; the lowest kind first.
enum class UsdTaskKind : std::uint8_t {
    relocates,
    impliedRelocate,
    references,
    payloads,
    inherits,
    specializes,
    impliedClasses
};
constexpr std::size_t kUsdTaskKinds = 7;

/// A variant set whose variant is still to be chosen.
struct UsdVariantTask {
    enum class Phase : std::uint8_t { authored, fallback, waiting, done };
    std::uint32_t node = 0;
    UsdSitePath site; ///< the node's path, or what is above it, where the set is
    std::string set;
    std::uint32_t number = 0;
    bool ancestral = false;
    Phase phase = Phase::authored;
    std::size_t seen = 0; ///< nodes that have no selection for it
};

/// Variant sets that are still to be chosen for, in the order in which that is done: those of
/// ancestors first, strong nodes first; a fallback only when no selection is left to be found.
struct UsdVariantQueue {
    std::vector<UsdVariantTask> tasks;
    std::vector<std::size_t> order;                   // numbers of tasks, once they are sorted
    std::array<std::array<std::size_t, 2>, 2> next{}; // in order: for ancestors or not, by phase
    bool sorted = false;
};

/// An arc to a prim that has to be there.
struct UsdExpectedPrim {
    std::uint32_t node = 0;
    SourceLocation where;
    std::string problem; ///< what to say if it isn't
};

/// An index that grows, with what is left to do. If it is made for an arc of another one, that one
/// waits: cycles and repeated sites are searched for in all of them.
struct UsdGraph {
    UsdPrimIndex index;
    UsdSitePath asked; ///< the index's path when it will be complete
    const UsdGraph* waiting = nullptr;
    std::uint32_t waitingParent = kNoNode; ///< what this graph will hang from
    UsdArc arc = UsdArc::root;             ///< by which it will
    bool mayRepeat = true;                 ///< arcs to sites that are there already
    bool choosesVariants = false;          ///< the outermost one does
    std::array<std::deque<std::uint32_t>, kUsdTaskKinds> tasks;
    std::unordered_set<std::uint32_t> implied; ///< nodes of tasks of kind impliedClasses
    UsdVariantQueue variants;
    /// Arcs whose prim must be there when all is done; variants may still bring it.
    std::vector<UsdExpectedPrim> expected;

    /// Classes are implied from a node once, however often that is asked for before it is done.
    void push(UsdTaskKind kind, std::uint32_t node) {
        if (kind == UsdTaskKind::impliedClasses && !implied.insert(node).second) return;
        tasks[std::size_t(kind)].push_back(node);
    }
    /// The first task of a kind that has some.
    std::uint32_t pop(UsdTaskKind kind) {
        auto& queue = tasks[std::size_t(kind)];
        const std::uint32_t node = queue.front();
        queue.pop_front();
        if (kind == UsdTaskKind::impliedClasses) implied.erase(node);
        return node;
    }
    /// Whether the arcs from `parent` outward, in waiting graphs too, have a site above or below
    /// this one.
    bool isCycle(std::uint32_t parent, const UsdLayerStack* stack, UsdSitePath path) const;
    /// Whether a node of this site speaks, here or in a waiting graph.
    bool speaksAlready(const UsdLayerStack* stack, UsdSitePath path) const;
    /// Whether `node` is a relocate, or the root of what will hang from one.
    bool isRelocate(std::uint32_t node) const {
        return (node == 0 ? arc : index[node].arc) == UsdArc::relocate;
    }
    /// Arcs from `node` outward.
    std::size_t arcDepth(std::uint32_t node) const;
    /// The place of each node in the order of strength.
    const std::vector<std::uint32_t>& ranks() const;
    void forgetRanks() { ranks_.clear(); }
    /// To be called when paths have changed.
    void forgetSites() {
        sites_.clear();
        known_ = 0;
    }

private:
    bool speaks(const UsdLayerStack* stack, UsdSitePath path) const;

    mutable std::unordered_multimap<UsdSitePath, std::uint32_t> sites_;
    mutable std::size_t known_ = 0; // nodes in it
    mutable std::vector<std::uint32_t> ranks_;
};

/// `result`, a plain path, within the variants of `path` if it is below them.
UsdSitePath withChoicesOf(UsdSitePath path, UsdSitePath result);

} // namespace penumbra
