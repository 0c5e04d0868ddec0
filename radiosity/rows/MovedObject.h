// What moved since an entry was last up to date, and whether the entry may depend on it.
#pragma once

#include "radiosity/mesh/PatchSet.h"
#include "radiosity/rows/Row.h"

#include <cstdint>
#include <span>

namespace penumbra {

/// An object that is not where it was.
struct MovedObject {
    std::uint32_t object = 0;
    bool present = true;
    Bounds box; ///< where it is now, a hair more [m, world]
};

bool isAmong(std::span<const MovedObject> moved, std::uint32_t object);

/// Whether any of them may stand between a receiver and what lies in a box [m, world].
bool mayStandBefore(std::span<const MovedObject> moved, const Receiver& receiver,
                    const Bounds& box);

/// Whether an entry may have changed: it is visible in part and something may stand before
/// it, or what blocked it has moved. \param box of the sender [m, world]
bool mayDiffer(const RowBlock::Draft& draft, std::span<const MovedObject> moved,
               const Receiver& receiver, const Bounds& box);

} // namespace penumbra
