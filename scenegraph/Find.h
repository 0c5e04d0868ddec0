// From a path back to the nodes.
#pragma once

#include "scenegraph/Group.h"

#include <string_view>
#include <vector>

namespace penumbra {

/// The nodes from below `root` down to the one at `path`, e.g. "/World/Seat": those whose names it
/// is made of, as Visitor::path() gives them. Of several with one name the first that the rest of
/// the path goes on below. Empty if there is none, and for "/".
std::vector<NodePtr> nodesAlong(const Group& root, std::string_view path);

} // namespace penumbra
