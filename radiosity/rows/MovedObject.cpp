#include "radiosity/rows/MovedObject.h"

#include "radiosity/rays/Shaft.h"

#include <algorithm>

namespace penumbra {

bool isAmong(std::span<const MovedObject> moved, std::uint32_t object) {
    return std::any_of(moved.begin(), moved.end(),
                       [&](const MovedObject& m) { return m.object == object; });
}

bool mayStandBefore(std::span<const MovedObject> moved, const Receiver& receiver,
                    const Bounds& box) {
    const Bounds point{receiver.position, receiver.position};
    return std::any_of(moved.begin(), moved.end(), [&](const MovedObject& m) {
        return m.present && shaftMeets(point, box, m.box);
    });
}

bool mayDiffer(const RowBlock::Draft& draft, std::span<const MovedObject> moved,
               const Receiver& receiver, const Bounds& box) {
    if (draft.visible != 0 && mayStandBefore(moved, receiver, box)) return true;
    return std::any_of(draft.blockers.begin(), draft.blockers.begin() + draft.blockerCount,
                       [&](const Blocker& b) { return isAmong(moved, b.object); });
}

} // namespace penumbra
