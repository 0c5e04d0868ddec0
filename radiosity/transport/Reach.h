// Where light can get to at all.
#pragma once

#include "radiosity/mesh/PatchSet.h"

#include <cstdint>
#include <span>
#include <vector>

namespace penumbra {

/// The outsides of a room's walls and the insides of its hollow things are many; no light ever gets
/// there, and no row needs an entry for their nodes. A node can be reached if one of a few rays
/// from it meets a patch that an emitter lights, or one with a node that can be reached. The rays
/// see the fixed part only, and what is movable can always be reached: so nothing has to be traced
/// when things move.
class Reach {
public:
    Reach() = default;
    /// Traces the rays. `set` must outlive this.
    explicit Reach(const PatchSet& set);

    /// Finds the nodes that can be reached. \param lit 1: patches that some emitter lights
    /// \return bits, 64 nodes a word
    std::vector<std::uint64_t> spread(std::span<const std::uint8_t> lit) const;

    std::uint64_t rayCount() const { return seen_.size(); }

private:
    const PatchSet* set_ = nullptr;
    std::vector<std::uint32_t> seen_; ///< patch that each ray meets, Element::kNone: none
};

} // namespace penumbra
