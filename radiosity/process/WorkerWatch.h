// Whether a worker in a process of its own is still at work.
#pragma once

#include "radiosity/process/memory/ControlBlock.h"

#include <cstdint>
#include <string>

namespace penumbra {

/// Listens to a worker's beat and counts its turns, by a clock that stops while this program is
/// stopped.
class WorkerWatch {
public:
    /// \param timeout nothing heard for so long: it hangs [s]
    explicit WorkerWatch(double timeout) : timeout_(timeout) {}

    /// A worker that has just been started.
    void begin() { silence_ = standstill_ = 0, beat_ = turns_ = 0; }
    /// \param passed since the last call [s] \param byHand a person starts it, at any time
    /// \param meshing it may take long over one turn
    /// \return what is wrong; empty: nothing
    std::string listen(const ControlBlock& block, double passed, bool byHand, bool meshing);

    static constexpr double kStandstill = 120; ///< a turn of the work takes less [s]

private:
    double timeout_;
    double silence_ = 0, standstill_ = 0; ///< since the last beat, the last turn [s]
    std::uint64_t beat_ = 0, turns_ = 0;
};

} // namespace penumbra
