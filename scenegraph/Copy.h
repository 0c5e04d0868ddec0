// A thing once more.
#pragma once

#include "scenegraph/Node.h"

#include <functional>
#include <string>

namespace penumbra {

/// A copy of a node and of what is below it, which can be edited by itself: its groups, transforms,
/// switches and lights are others, of the same names. Meshes never change and are shared, with the
/// materials that they are painted with. Null: the node is a camera, or something that is drawn for
/// another program; below it these are left out.
/// \param name of the copy; what is below keeps its names
/// \param made called for every node and its copy, if there is one
NodePtr copyOf(const NodePtr& node, const std::string& name,
               const std::function<void(const NodePtr& node, const NodePtr& copy)>& made);

} // namespace penumbra
