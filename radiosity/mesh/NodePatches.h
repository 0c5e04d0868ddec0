// Which patches receive at a node.
#pragma once

#include "radiosity/mesh/PatchSet.h"

#include <cstdint>
#include <span>
#include <vector>

namespace penumbra {

/// The patches of every node, ascending.
class NodePatches {
public:
    explicit NodePatches(const PatchSet& set);
    std::span<const std::uint32_t> of(std::uint32_t node) const {
        return std::span(patches_).subspan(first_[node], first_[node + 1] - first_[node]);
    }

private:
    std::vector<std::uint32_t> first_, patches_;
};

} // namespace penumbra
