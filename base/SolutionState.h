// How far a solution is: the one answer that everybody reads.
#pragma once

#include <cstdint>

namespace penumbra {

/// How far the light of a scene is; a later one is more. It is computed by stateOf() alone, from
/// what is left, and passed on as it is: who publishes, sends or reads light can only say
/// `working` instead for as long as some of the light is still on its way.
///
/// It is about the scene, not about a view. "Nothing more to be seen" is about one view, and holds
/// sooner or later than `certified`: it is to be a second answer beside this one, computed here
/// from the same WorkLeft with bounds in units of what the eye can tell in that view, and
/// published beside it (WorkerStatus, RadiosityState). So no value of this enum means it.
enum class SolutionState : std::uint8_t {
    working,   ///< work is left that the certificate counts, or fine shadows are
    certified, ///< within the certificate that was asked for, fine shadows included; some work is
               ///< deferred, and bounded by the certificate
    exact      ///< nothing is left: what a solution from scratch comes to
};

/// What a solution lacks.
struct WorkLeft {
    bool certificate = true; ///< it is above what was asked for, or not known
    bool fineShadows = true; ///< they do not follow from the light to within the certificate
    bool deferred = true;    ///< there is deferred work, which the certificate covers
};

constexpr SolutionState stateOf(const WorkLeft& left) {
    if (left.certificate || left.fineShadows) return SolutionState::working;
    return left.deferred ? SolutionState::certified : SolutionState::exact;
}

/// As people and files read it.
constexpr const char* nameOf(SolutionState state) {
    switch (state) {
    case SolutionState::working:
        return "working";
    case SolutionState::certified:
        return "certified";
    case SolutionState::exact:
        break;
    }
    return "exact";
}

} // namespace penumbra
