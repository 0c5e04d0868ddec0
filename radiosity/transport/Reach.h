// Where light can get to at all.
#pragma once

#include "radiosity/mesh/PatchSet.h"
#include "radiosity/transport/NodeHits.h"

#include <cstdint>
#include <span>
#include <vector>

namespace penumbra {

/// The outsides of a room's walls and the insides of its hollow things are many; no light ever gets
/// there, and no row needs an entry for their nodes. A node can be reached if one of its rays meets
/// a patch that light gets to: one that an emitter lights, or one with a node that can be reached.
/// That is so whether emitters are on or off, and of the scene as it stands: what is hidden is not
/// reached. Of all sets of nodes of which that is true it is the least one.
struct Reach {
    std::vector<std::uint64_t> nodes;  ///< bits, 64 nodes a word
    std::vector<std::uint8_t> patches; ///< 1: light gets to it
    /// Bits, likewise: nodes of which all rays meet such patches. Form factors add up to 1 there.
    std::vector<std::uint64_t> enclosed;

    bool node(std::uint32_t index) const { return nodes[index / 64] >> index % 64 & 1; }
    bool isEnclosed(std::uint32_t index) const { return enclosed[index / 64] >> index % 64 & 1; }
    bool operator==(const Reach&) const = default;
};

/// Finds it without a ray, in a time that goes with the number of hits.
/// \param lit 1: patches that some emitter lights
/// \pre hits.done()
Reach findReach(const PatchSet& set, const NodeHits& hits, std::span<const std::uint8_t> lit);

} // namespace penumbra
