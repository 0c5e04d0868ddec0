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
    double metersPerUnit = 1;  ///< of the file; already applied to the graph
    double startTimeCode = 0;  ///< first and last frame of the file's animation
    double endTimeCode = 0;
    double timeCodesPerSecond = 24;
};

} // namespace penumbra
