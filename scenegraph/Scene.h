// A scene: the root of a graph and what the file said about it as a whole.
#pragma once

#include "scenegraph/Group.h"

#include <memory>
#include <string>

namespace penumbra {

enum class UpAxis { y = 1, z = 2 };

/// A whole scene. Below the root everything is in metres, in the file's own axes.
struct Scene {
    std::shared_ptr<Group> root = std::make_shared<Group>("");
    std::string name;          ///< file name, for people
    UpAxis upAxis = UpAxis::y; ///< which axis of the scene frame points up
    double patchSize = 0;      ///< longest edge of a patch that the file asks for [m]; 0: none
    double elementSize = 0;    ///< the same of an element [m]
    double residual = 0;       ///< of the light that the file asks for, see SolverOptions; 0: none
    std::string
        trigger; ///< when edits are to be lit, implicit, onDemand, continuous; empty: not said
    std::string policy;       ///< in which order, importance, plain; empty: not said
    double metersPerUnit = 1; ///< of the file; already applied to the graph
    double startTimeCode = 0; ///< first and last frame of the file's animation
    double endTimeCode = 0;
    double timeCodesPerSecond = 24;
};

} // namespace penumbra
