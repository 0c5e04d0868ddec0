#include "radiosity/process/WorkerWatch.h"

#include <utility>

namespace penumbra {

std::string WorkerWatch::listen(const ControlBlock& block, double passed, bool byHand,
                                bool meshing) {
    constexpr double kStart = 20; // a process has so long to begin [s]
    const std::uint64_t beat = block.beat.load(std::memory_order_relaxed);
    const std::uint64_t turns = block.turns.load(std::memory_order_relaxed);
    silence_ = std::exchange(beat_, beat) == beat ? silence_ + passed : 0;
    standstill_ = std::exchange(turns_, turns) == turns ? standstill_ + passed : 0;
    if (beat == 0 && byHand) return {};
    if (silence_ > (beat == 0 ? kStart : timeout_)) return "the process does not answer";
    if (standstill_ > kStandstill && !meshing) return "the process is stuck";
    return {};
}

} // namespace penumbra
