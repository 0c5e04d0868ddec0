// What two meshings of a scene have in common.
#pragma once

#include "radiosity/mesh/PatchSet.h"

#include <cstdint>
#include <vector>

namespace penumbra {

/// Which parts of a patch set are, bit for bit, parts of the one before it. What lies between them
/// may differ: `changed` says where.
struct PatchMatch {
    static constexpr std::uint32_t kNew = 0xffffffffu;

    std::vector<std::uint32_t> objects;                   ///< one before: what it is called now
    std::vector<std::uint32_t> emitters, vertices, nodes; ///< one now: its number before, or kNew
    /// Now: of another shape or elsewhere, new, hidden or shown, or gone. Nothing of theirs counts
    /// as known.
    std::vector<ObjectId> changed;

    bool isChanged(ObjectId object) const;
};

/// Compares two meshings. \pre keepGone(before, now)
PatchMatch matchPatches(const PatchSet& before, const PatchSet& now);

/// Adds the objects of `before` that `now` does not have, empty: what they blocked can be asked for
/// by their names. \param all if false, only those that had a shape before
void keepGone(const PatchSet& before, PatchSet& now, bool all);

} // namespace penumbra
