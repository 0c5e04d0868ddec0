// How far the light below a RadiosityNode is.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace penumbra {

struct RadiosityState {
    enum class Phase {
        off,        ///< stopped
        connecting, ///< the other side is being started
        meshing,    ///< it has the scene, and cuts it into patches
        solving,    ///< it works on the light
        settled,    ///< the light is that of the scene as it was sent, within the certificate
        failed      ///< this scene can't be lit, see takeMessages(); an edit has it tried again
    };
    Phase phase = Phase::connecting;
    bool complete = false;       ///< settled, and nothing is put off any more
    std::string task;            ///< of phase solving, e.g. "direct light"
    double progress = 0;         ///< share of the task that is done, in [0, 1]
    double certificate = 0;      ///< bound of |B_exact - B| for the meshed scene [lm/m^2]
    double meanRadiosity = 0;    ///< area-weighted, of reflecting surfaces [lm/m^2]
    std::size_t held = 0;        ///< edits that the trigger holds back
    std::size_t queued = 0;      ///< edits sent, or about to be, that are not taken in yet
    std::size_t dirtyBlocks = 0; ///< blocks with light to be published
    bool dirtyMarked = false;    ///< what is stale of live lamps takes in all edits that were sent
    double age = 0;              ///< of the oldest edit that is not in the light; 0: settled [s]
    std::uint64_t updates = 0;   ///< how often edits were let through by the trigger
    unsigned restarts = 0;       ///< of the other side, after it had failed
    std::uint64_t blocksTaken = 0; ///< blocks copied so far
};

} // namespace penumbra
