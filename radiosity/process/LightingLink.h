// How a RadiosityNode has its light computed: in a thread, or in a process.
#pragma once

#include "radiosity/process/memory/Region.h"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace penumbra {

struct WorkerLimits {
    unsigned threads = 0; ///< 0: one a core; one less in a thread of the program
    int niceness = 0;
    std::size_t memory = 0; ///< instead of what the viewer asks for [bytes]; 0: that
};

/// Where a worker lives, and the memory to talk to it. One worker at a time.
class LightingLink {
public:
    virtual ~LightingLink() = default;
    virtual Regions& regions() = 0;
    /// Starts a worker at a control block. \throws Error
    virtual void start(const RegionPtr& control, const WorkerLimits& limits) = 0;
    /// Why the worker has ended; none: it runs. Never waits.
    virtual std::optional<std::string> ended() = 0;
    /// Ends the worker, by force if it can be.
    virtual void end() = 0;
    /// Whether the worker can be ended by force, and says that it is alive while it is busy.
    virtual bool apart() const = 0;
    /// Whether people start it: nobody knows when.
    virtual bool byHand() const { return false; }
};

/// A thread of this process: for programs that want no second one, and for tests. What it does
/// can't be broken off: end() waits until it has finished meshing, at worst.
std::unique_ptr<LightingLink> makeThreadLink();

} // namespace penumbra
