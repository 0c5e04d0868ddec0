// The index of a prim: all sites that say something about it, as a tree of arcs.
#pragma once

#include "io/usd/compose/UsdLayerStack.h"

#include <cstdint>
#include <string>
#include <vector>

namespace penumbra {

/// How a node came to its parent, strongest first.
enum class UsdArc : std::uint8_t {
    root,
    inherit,
    variant,
    relocate,
    reference,
    payload,
    specialize
};

const char* nameOf(UsdArc arc);

inline bool isClassArc(UsdArc arc) {
    return arc == UsdArc::inherit || arc == UsdArc::specialize;
}

constexpr std::uint32_t kNoNode = ~0u;

/// A site, and how it was reached.
struct UsdNode {
    const UsdLayerStack* stack = nullptr;
    UsdSitePath path;
    UsdArc arc = UsdArc::root;
    std::uint32_t parent = kNoNode;
    std::uint32_t origin = kNoNode; ///< what caused the arc: the parent if it is written there
    UsdMappingPtr toParent;
    UsdMappingPtr toRoot;                ///< null until it is asked for: see UsdPrimIndex::toRoot()
    std::vector<std::uint32_t> children; ///< strongest first
    std::uint32_t sibling = 0;           ///< number among arcs of one list
    std::uint32_t depth = 0;             ///< levels of the parent's path when the arc was made
    std::uint32_t bar = 0;  ///< length of the path when it fell silent; 1: it never spoke
    bool silent = false;    ///< says nothing, has no arcs; may be an origin
    bool cut = false;       ///< hidden by a relocate
    bool ancestral = false; ///< the arc is one of an ancestor of the prim
    bool hasSpecs = false;

    bool speaks() const { return !silent && !cut; }
};

/// Nodes refer to each other by number; [0] is the root.
class UsdPrimIndex {
public:
    std::vector<UsdNode> nodes;

    const UsdNode& operator[](std::uint32_t node) const { return nodes[node]; }
    UsdNode& operator[](std::uint32_t node) { return nodes[node]; }
    UsdSitePath path() const { return nodes.front().path; }

    /// Levels of a node's path below where its arc was made.
    std::size_t below(std::uint32_t node) const;
    UsdSitePath pathAtIntroduction(std::uint32_t node) const;
    /// Whether `node` is `above` or hangs below it.
    bool hangsAt(std::uint32_t node, std::uint32_t above) const;
    /// Where the origins of a node lead: to an arc that is written in its parent.
    std::uint32_t originRoot(std::uint32_t node) const;
    /// Whether `a` comes before `b` in the tree, specializes left where they are.
    bool isBefore(std::uint32_t a, std::uint32_t b) const;
    /// Puts a node whose graph is complete among its parent's children.
    void place(std::uint32_t node);
    /// The same for one that is among them and got another origin.
    void placeAgain(std::uint32_t node);
    void silence(std::uint32_t node);
    void cut(std::uint32_t node);
    /// The nodes at or below `node`.
    std::vector<std::uint32_t> subtree(std::uint32_t node) const;
    /// Whether some layer says something at or below `node`.
    bool anySpecs(std::uint32_t node) const;
    /// All nodes, strongest first; specializes after all others.
    std::vector<std::uint32_t> strengthOrder() const;
    /// How paths and times of a node become those of the stage.
    const UsdMapping& toRoot(std::uint32_t node);

private:
    bool isStronger(std::uint32_t a, std::uint32_t b) const;
};

/// Of an instance (`instanceable` by its strongest opinion, and brought by an arc): the nodes whose
/// contents it shares with others. Empty if it is none.
std::vector<bool> sharedNodes(const UsdPrimIndex& index);

} // namespace penumbra
