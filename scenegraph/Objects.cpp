#include "scenegraph/Objects.h"

#include "scenegraph/Camera.h"
#include "scenegraph/Light.h"
#include "scenegraph/Mesh.h"
#include "scenegraph/Transform.h"
#include "scenegraph/Visitor.h"

namespace penumbra {

namespace {

/// Whether a transform has geometry of its own: below it, but above the next transform.
class HoldsGeometry : public Visitor {
public:
    static bool test(const Transform& transform) {
        HoldsGeometry visitor;
        visitor.traverse(transform);
        return visitor.found_;
    }
    using Visitor::visit;
    void visit(const Transform&) override {}
    void visit(const Mesh&) override { found_ = true; }
    void visit(const Light&) override { found_ = true; }

private:
    bool found_ = false;
};

class Placer : public Visitor {
public:
    explicit Placer(PlacedScene& out) : out_(out) {}

    using Visitor::visit;
    void visit(const Transform& transform) override {
        const bool begins = transform.movable() || (depth_ == 0 && HoldsGeometry::test(transform));
        if (!begins) return Visitor::visit(transform);
        const Pending outer = pending_;
        pending_ = {path(), toWorld() * transform.matrix(), transform.movable(), {}};
        ++depth_;
        Visitor::visit(transform);
        --depth_;
        pending_ = outer;
    }
    void visit(const Mesh& mesh) override {
        out_.meshes.push_back({&mesh, toWorld(), currentObject(), path()});
        out_.bounds.add(transformed(mesh.bounds(), toWorld()));
    }
    void visit(const Light& light) override {
        out_.lights.push_back({&light, toWorld(), currentObject(), path()});
        out_.bounds.add(transformed(light.bounds(), toWorld()));
    }
    void visit(const Camera& camera) override {
        out_.cameras.push_back({&camera, toWorld(), pending_.id, path()});
    }

private:
    /// An object that has begun; it gets its id with its first piece of geometry.
    struct Pending {
        std::string path = "/";
        glm::dmat4 toWorld{1.0};
        bool movable = false;
        ObjectId id;
    };

    ObjectId currentObject() {
        if (!pending_.id.valid()) {
            pending_.id.value = std::uint32_t(out_.objects.size());
            out_.objects.push_back({pending_.path, pending_.toWorld, pending_.movable});
        }
        return pending_.id;
    }

    PlacedScene& out_;
    Pending pending_;
    int depth_ = 0;
};

} // namespace

PlacedScene placeScene(const Scene& scene) {
    PlacedScene placed;
    Placer placer(placed);
    scene.root->accept(placer);
    return placed;
}

} // namespace penumbra
