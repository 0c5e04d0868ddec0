#include "scenegraph/Find.h"

#include <algorithm>

namespace penumbra {

std::vector<NodePtr> nodesAlong(const Group& root, std::string_view path) {
    if (!path.starts_with('/') || path.size() == 1) return {};
    const std::size_t end = std::min(path.find('/', 1), path.size());
    const std::string_view name = path.substr(1, end - 1), rest = path.substr(end);
    for (const NodePtr& child : root.children()) {
        if (child->name() != name) continue;
        if (rest.empty()) return {child};
        const auto* const group = dynamic_cast<const Group*>(child.get());
        if (!group) continue;
        std::vector<NodePtr> below = nodesAlong(*group, rest);
        if (below.empty()) continue;
        below.insert(below.begin(), child);
        return below;
    }
    return {};
}

} // namespace penumbra
