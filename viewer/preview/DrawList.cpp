#include "viewer/preview/DrawList.h"

#include "scenegraph/Light.h"
#include "scenegraph/LitGeometry.h"
#include "scenegraph/Mesh.h"
#include "scenegraph/Visitor.h"

#include <cassert>
#include <utility>

namespace penumbra {

namespace {

class CullVisitor : public Visitor {
public:
    CullVisitor(const Group& root, const Frustum& frustum) : root_(root), frustum_(frustum) {}

    using Visitor::visit;
    void visit(const LitGeometry& geometry) override {
        if (inView(geometry.bounds()))
            list.items.push_back({&geometry, &parent(), toWorld(), nullptr});
    }
    void visit(const Mesh& mesh) override {
        if (inView(mesh.bounds())) list.unlit.push_back({&mesh, nullptr, &parent(), toWorld()});
    }
    void visit(const Light& light) override {
        if (inView(light.bounds())) list.unlit.push_back({nullptr, &light, &parent(), toWorld()});
    }

    DrawList list;

private:
    bool inView(const Bounds& local) {
        const bool seen = frustum_.mayContain(transformed(local, toWorld()));
        list.culled += !seen;
        return seen;
    }

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

std::weak_ptr<const Node> ownerOf(const Group& parent, const Node& node) {
    for (const NodePtr& child : parent.children())
        if (child.get() == &node) return child;
    assert(!"a draw item's parent holds its node");
    return {};
}

} // namespace penumbra
