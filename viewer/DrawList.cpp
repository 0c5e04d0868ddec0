#include "viewer/DrawList.h"

#include "scenegraph/LitGeometry.h"
#include "scenegraph/Visitor.h"

#include <utility>

namespace penumbra {

namespace {

class CullVisitor : public Visitor {
public:
    CullVisitor(const Group& root, const Frustum& frustum) : root_(root), frustum_(frustum) {}

    using Visitor::visit;
    void visit(const LitGeometry& geometry) override {
        if (!frustum_.mayContain(transformed(geometry.bounds(), toWorld()))) {
            ++list.culled;
            return;
        }
        list.items.push_back({&geometry, &parent(), toWorld()});
    }

    DrawList list;

private:
    /// Whatever has a node below it is a group.
    const Group& parent() const {
        const std::vector<const Node*>& path = nodePath();
        return path.size() < 2 ? root_ : static_cast<const Group&>(*path[path.size() - 2]);
    }

    const Group& root_;
    const Frustum& frustum_;
};

} // namespace

DrawList listVisible(const Group& root, const Frustum& frustum) {
    CullVisitor visitor(root, frustum);
    root.accept(visitor);
    return std::move(visitor.list);
}

} // namespace penumbra
