// What people may choose about a RadiosityNode.
#pragma once

#include "radiosity/mesh/BuildPatches.h"
#include "radiosity/transport/Solver.h"
#include "scenegraph/Scene.h"

#include <cstddef>

namespace penumbra {

/// When edits are sent to be lit.
enum class Trigger {
    implicit,  ///< at once, but those of a node in someone's hand when it is grabbed and let go
    onDemand,  ///< when RadiosityNode::requestUpdate() is called
    continuous ///< at once, while it is being dragged as well
};

struct RadiosityOptions {
    MeshingOptions meshing{};
    SolverOptions solving{};
    Trigger trigger = Trigger::implicit;
    unsigned threads = 0; ///< 0: one a core, but one is left to the renderer
    int niceness = 5;     ///< of a process, see nice(1)
    /// Nothing heard from the other side for so long: it hangs [s].
    double timeout = 2;
    std::size_t mostMemory = std::size_t(4) << 30; ///< shared at most [bytes]
};

/// The defaults, and what the scene's file asks for.
RadiosityOptions optionsOf(const Scene& scene);

} // namespace penumbra
