// Work on dirty groups of receivers, a piece at a time.
#pragma once

#include "base/Bounds.h"
#include "base/Parallel.h"
#include "radiosity/schedule/DirtyGroups.h"
#include "radiosity/schedule/WorkCosts.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace penumbra {

/// What was done for groups of receivers so far.
struct GroupCount {
    std::uint64_t rays = 0, groups = 0;
};

/// What became of one group.
struct GroupOutcome {
    std::uint64_t rays = 0;
    Bounds ways;               ///< around all that was followed [m, world]
    std::uint32_t changed = 0; ///< bits: receivers of which whoever notes it is told
    bool differs = false;      ///< anything that was met
};

/// Traces about `effort` rays' worth of dirty groups, and cleans these. How many rays an edit
/// concerns can't be known before: a few groups at a time.
/// \param rays  about how many a receiver needs of which nothing is known
/// \param trace finds out of a group what is to be known; called on several threads
/// \param note  is told what became of each group, in their order
/// \return whether there was anything to do
template <class Trace, class Note>
bool workOnGroups(DirtyGroups& dirty, std::size_t rays, std::size_t effort, GroupCount& count,
                  const Trace& trace, const Note& note) {
    constexpr std::size_t kGroupsATask = 2;
    if (dirty.done()) return false;
    const std::size_t few = std::max<std::size_t>(effort / 16, 256);
    for (std::size_t spent = 0; spent < effort && !dirty.done();) {
        const auto groups = dirty.next(few, rays);
        std::vector<GroupOutcome> outcomes(groups.size());
        parallelFor(groups.size(), kGroupsATask, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) outcomes[i] = trace(groups[i]);
        });
        std::vector<Bounds> ways;
        for (std::size_t i = 0; i < outcomes.size(); ++i) {
            count.rays += outcomes[i].rays;
            spent += cost::kDetailVisit + outcomes[i].rays;
            ways.push_back(outcomes[i].ways);
            note(groups[i], outcomes[i]);
        }
        count.groups += ways.size();
        dirty.clean(ways);
    }
    return true;
}

} // namespace penumbra
