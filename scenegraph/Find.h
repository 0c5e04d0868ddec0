// From a path back to the nodes.
#pragma once

#include "scenegraph/Group.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

namespace penumbra {

/// All nodes at a path, e.g. "/World/Seat", as Visitor::path() gives it, in the order in which they
/// are visited. There may be several: a node shares its path with nameless ones below, and others
/// may have its name. Empty if there is none, and for "/".
std::vector<NodePtr> nodesAt(const Group& root, std::string_view path);

/// The first of them that is a T; null: there is none.
template <class T>
std::shared_ptr<T> findAt(const Group& root, std::string_view path) {
    for (const NodePtr& node : nodesAt(root, path))
        if (auto found = std::dynamic_pointer_cast<T>(node)) return found;
    return nullptr;
}

/// Where a node is among the children of another one.
struct ChildPlace {
    std::shared_ptr<Group> parent;
    std::size_t index = 0;
};

/// Where `node` is, if it is one of nodesAt() this path. A node may have several parents: the
/// first that this path leads through.
std::optional<ChildPlace> placeOf(const std::shared_ptr<Group>& root, std::string_view path,
                                  const Node& node);

} // namespace penumbra
