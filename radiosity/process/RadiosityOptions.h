// What people may choose about a RadiosityNode.
#pragma once

#include "base/LightRequest.h"
#include "radiosity/mesh/BuildPatches.h"
#include "radiosity/transport/Solver.h"

#include <cstddef>

namespace penumbra {

struct RadiosityOptions {
    MeshingOptions meshing{};
    SolverOptions solving{};
    Trigger trigger = Trigger::implicit;
    unsigned threads = 0; ///< 0: one a core; one less in a thread of the program
    int niceness = 5;     ///< of a process, see nice(1)
    /// Nothing heard from the worker for so long: it hangs [s].
    double timeout = 2;
    std::size_t mostMemory = std::size_t(4) << 30; ///< shared at most [bytes]
};

/// What is asked for, and where nothing is, what `options` say.
RadiosityOptions optionsFor(const LightRequest& request, RadiosityOptions options = {});

} // namespace penumbra
