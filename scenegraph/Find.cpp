#include "scenegraph/Find.h"

#include <string>

namespace penumbra {

namespace {

/// Takes the first name off a path. False, and nothing is taken, if it is another.
bool takeName(std::string_view& path, const std::string& name) {
    if (name.empty()) return true;
    if (!path.starts_with('/') || !path.substr(1).starts_with(name)) return false;
    const std::string_view rest = path.substr(1 + name.size());
    if (!rest.empty() && rest.front() != '/') return false;
    path = rest;
    return true;
}

void collect(const Group& group, std::string_view path, std::vector<NodePtr>& found) {
    for (const NodePtr& child : group.children()) {
        std::string_view rest = path;
        if (!takeName(rest, child->name())) continue;
        if (rest.empty()) found.push_back(child);
        if (const auto* const below = dynamic_cast<const Group*>(child.get()))
            collect(*below, rest, found);
    }
}

} // namespace

std::vector<NodePtr> nodesAt(const Group& root, std::string_view path) {
    std::vector<NodePtr> found;
    if (path.size() > 1 && path.front() == '/') collect(root, path, found);
    return found;
}

} // namespace penumbra
