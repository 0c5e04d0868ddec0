// Which patches receive at a node.
#pragma once

#include "radiosity/mesh/PatchSet.h"

#include <cstdint>
#include <span>
#include <vector>

namespace penumbra {

/// The patches of the mesh at every node, ascending. Of a node that was handed out (PatchParts) it
/// is the one that it was handed out for, if it is in use.
class NodePatches {
public:
    /// `set` must outlive this.
    explicit NodePatches(const PatchSet& set);
    /// Takes in patches of the mesh that came to be, and their nodes. \pre no node behind these has
    /// any
    void add(Range patches, Range nodes);
    std::span<const std::uint32_t> of(std::uint32_t node) const {
        const PatchParts& parts = set_->parts;
        if (node + 1 >= first_.size()) {
            const auto at = std::span(parts.nodePatch).subspan(node - parts.firstNode, 1);
            return at[0] != Element::kNone ? at : at.first(0);
        }
        return std::span(patches_).subspan(first_[node], first_[node + 1] - first_[node]);
    }

private:
    const PatchSet* set_;
    std::vector<std::uint32_t> first_, patches_;
};

} // namespace penumbra
