// What of a scene graph is in view.
#pragma once

#include "scenegraph/Frustum.h"
#include "scenegraph/Group.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <memory>
#include <vector>

namespace penumbra {

class Light;
class LitGeometry;
class Mesh;
struct ShownLight;

/// One lit surface in its pose. The pointers are good until the graph is edited.
struct DrawItem {
    const LitGeometry* geometry = nullptr;
    const Group* parent = nullptr; ///< one that holds the geometry
    glm::dmat4 toWorld{1.0};
    const ShownLight* shown = nullptr; ///< its light as it is to be drawn; null: its own
};

/// A mesh or a light that nobody has lit yet.
struct UnlitItem {
    const Mesh* mesh = nullptr;   ///< one of
    const Light* light = nullptr; ///< the two
    const Group* parent = nullptr;
    glm::dmat4 toWorld{1.0};
};

struct DrawList {
    std::vector<DrawItem> items;  ///< in traversal order
    std::vector<UnlitItem> unlit; ///< in traversal order
    std::size_t culled = 0;       ///< instances left out because they are outside of the view
};

/// Lists every instance of a LitGeometry, a Mesh or a Light below `root`, hidden ones (Switch) not
/// counted, whose box may be seen in `frustum`.
DrawList listVisible(const Group& root, const Frustum& frustum);

/// The owner of a node, found among its parent's children. While it lives, the address is not that
/// of a later node.
std::weak_ptr<const Node> ownerOf(const Group& parent, const Node& node);

} // namespace penumbra
