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

/// Calls visit(parent, index of the child) for every node at a path.
template <class Visit>
void forEachAt(const Group& group, std::string_view path, const Visit& visit) {
    for (std::size_t i = 0; i < group.children().size(); ++i) {
        const NodePtr& child = group.children()[i];
        std::string_view rest = path;
        if (!takeName(rest, child->name())) continue;
        if (rest.empty()) visit(group, i);
        if (const auto* const below = dynamic_cast<const Group*>(child.get()))
            forEachAt(*below, rest, visit);
    }
}

bool leadsBelow(std::string_view path) {
    return path.size() > 1 && path.front() == '/';
}

} // namespace

std::vector<NodePtr> nodesAt(const Group& root, std::string_view path) {
    std::vector<NodePtr> found;
    if (leadsBelow(path))
        forEachAt(root, path, [&](const Group& parent, std::size_t index) {
            found.push_back(parent.children()[index]);
        });
    return found;
}

std::optional<ChildPlace> placeOf(const std::shared_ptr<Group>& root, std::string_view path,
                                  const Node& node) {
    std::optional<ChildPlace> found;
    if (!leadsBelow(path)) return found;
    forEachAt(*root, path, [&](const Group& parent, std::size_t index) {
        if (found || parent.children()[index].get() != &node) return;
        const auto shared = std::const_pointer_cast<Node>(parent.shared_from_this());
        found = {std::static_pointer_cast<Group>(shared), index};
    });
    return found;
}

} // namespace penumbra
