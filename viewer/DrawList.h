// What of a scene graph is in view.
#pragma once

#include "scenegraph/Frustum.h"
#include "scenegraph/Group.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <vector>

namespace penumbra {

class LitGeometry;

/// One lit surface in its place. The pointers are good until the graph is edited.
struct DrawItem {
    const LitGeometry* geometry = nullptr;
    const Group* parent = nullptr; ///< one that holds the geometry
    glm::dmat4 toWorld{1.0};
};

struct DrawList {
    std::vector<DrawItem> items; ///< in traversal order
    std::size_t culled = 0;      ///< places left out because they are outside of the view
};

/// Lists every place of a LitGeometry below `root`, hidden ones (Switch) not counted, whose box may
/// be seen in `frustum`.
DrawList listVisible(const Group& root, const Frustum& frustum);

} // namespace penumbra
