// How far the light below a RadiosityNode is.
#pragma once

#include "base/SolutionState.h"

#include <cstddef>
#include <cstdint>
#include <string>

namespace penumbra {

struct RadiosityState {
    enum class Phase {
        off,        ///< stopped
        connecting, ///< the worker is being started
        meshing,    ///< it has the scene, and cuts it into patches
        solving,    ///< it lights the scene: how far it is, says `solution`
        failed      ///< this scene can't be lit, see takeMessages(); an edit has it tried again
    };
    Phase phase = Phase::connecting;
    /// Of the light that has been taken in, of the scene with all edits that were sent.
    SolutionState solution = SolutionState::working;
    bool stopped = false; ///< relaxation met its limit: it stays `working`, and nobody works
    bool rough = false;   ///< of a scene that was opened: direct light is an estimate still
    /// Whether there is nothing to wait for: it is reached, or will not be.
    bool reached(SolutionState wanted) const { return solution >= wanted || stopped; }
    std::string task;              ///< of phase solving, e.g. "direct light"
    double progress = 0;           ///< share of the task that is done, in [0, 1]
    double certificate = 0;        ///< bound of |B_exact - B| for the meshed scene [lm/m^2]
    double litIlluminance = 0;     ///< half of the lit area has more, see LitLevel [lux]
    std::size_t held = 0;          ///< edits that the trigger holds back
    std::size_t queued = 0;        ///< edits sent, or about to be, that are not taken in yet
    std::size_t dirtyBlocks = 0;   ///< blocks with light to be published
    bool dirtyMarked = false;      ///< marks of stale blocks take in all edits that were sent
    double age = 0;                ///< of the oldest edit that is not in the light; 0: all are [s]
    std::uint64_t updates = 0;     ///< how often edits were let through by the trigger
    unsigned restarts = 0;         ///< of the worker, after it had failed
    std::uint64_t blocksTaken = 0; ///< blocks copied so far
};

} // namespace penumbra
