#include "scenegraph/Objects.h"

#include "scenegraph/Camera.h"
#include "scenegraph/Light.h"
#include "scenegraph/Mesh.h"
#include "scenegraph/Transform.h"
#include "scenegraph/Visitor.h"

#include <algorithm>

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
    void visit(const Switch& node) override {
        hidden_ += !node.visible();
        traverse(node);
        hidden_ -= !node.visible();
    }
    void visit(const Transform& transform) override {
        const bool object =
            transform.beginsObject() || (depth_ == 0 && HoldsGeometry::test(transform));
        const bool begins = transform.movable() || (object && !pending_.movable);
        const glm::dmat4 outerFrame = toObject_;
        if (!begins) {
            toObject_ = toObject_ * transform.matrix();
            Visitor::visit(transform);
        } else {
            const Pending outer = pending_;
            pending_ = {path(), toWorld() * transform.matrix(), transform.movable(), hidden_, {}};
            toObject_ = glm::dmat4(1.0);
            ++depth_;
            Visitor::visit(transform);
            --depth_;
            pending_ = outer;
        }
        toObject_ = outerFrame;
    }
    void visit(const Mesh& mesh) override {
        if (leftOut()) return;
        out_.meshes.push_back({&mesh, toWorld(), toObject_, currentObject(), path()});
        if (hidden_ == 0) out_.bounds.add(transformed(mesh.bounds(), toWorld()));
    }
    void visit(const Light& light) override {
        if (leftOut()) return;
        out_.lights.push_back({&light, toWorld(), toObject_, currentObject(), path()});
        if (hidden_ == 0) out_.bounds.add(transformed(light.bounds(), toWorld()));
    }
    void visit(const Camera& camera) override {
        if (hidden_ == 0)
            out_.cameras.push_back({&camera, toWorld(), toObject_, pending_.id, path()});
    }

private:
    /// An object that has begun; it gets its id with its first piece of geometry.
    struct Pending {
        std::string path = "/";
        glm::dmat4 toWorld{1.0};
        bool movable = false;
        int hidden = 0; ///< hiding switches above it
        ObjectId id;
    };

    /// Hidden, and not as a movable object as a whole.
    bool leftOut() const { return hidden_ > (pending_.movable ? pending_.hidden : 0); }

    ObjectId currentObject() {
        if (!pending_.id.valid()) {
            pending_.id.value = std::uint32_t(out_.objects.size());
            out_.objects.push_back(
                {pending_.path, pending_.toWorld, pending_.movable, pending_.hidden == 0});
        }
        return pending_.id;
    }

    PlacedScene& out_;
    Pending pending_;
    glm::dmat4 toObject_{1.0}; ///< of the node being visited
    int depth_ = 0, hidden_ = 0;
};

} // namespace

PlacedScene placeScene(const Scene& scene) {
    PlacedScene placed;
    Placer placer(placed);
    scene.root->accept(placer);
    return placed;
}

bool hasLights(const PlacedScene& scene) {
    const auto emits = [](const Placed<Mesh>& mesh) {
        const auto& materials = mesh.node->data().materials;
        return std::any_of(materials.begin(), materials.end(),
                           [](const auto& material) { return material->emissive(); });
    };
    return !scene.lights.empty() || std::any_of(scene.meshes.begin(), scene.meshes.end(), emits);
}

} // namespace penumbra
