// Where a prim's frame is in the world while the animation plays.
#pragma once

#include "scenegraph/Transform.h"

#include <glm/glm.hpp>

#include <memory>

namespace penumbra {

/// The frame of a prim or of what is below it. It follows the transforms above it that the
/// animation changes; a frame without such transforms is one matrix.
class UsdFrame {
public:
    /// Local to world, column vectors, scene units, with the matrices that the nodes have now.
    glm::dmat4 toWorld() const;
    /// Whether the animation changes toWorld().
    bool moves() const { return motion_ != nullptr; }
    /// The frame below a node in this frame. \param changes the animation changes its matrix
    UsdFrame below(std::shared_ptr<const Transform> node, bool changes) const;

private:
    struct Motion;
    glm::dmat4 fixed_{1.0};                // of a frame that does not move
    std::shared_ptr<const Motion> motion_; // of one that does
};

} // namespace penumbra
