#include "scenegraph/Copy.h"

#include "scenegraph/Light.h"
#include "scenegraph/Mesh.h"
#include "scenegraph/Transform.h"

namespace penumbra {

namespace {

/// The node alone.
NodePtr copyOfOne(const NodePtr& node, const std::string& name) {
    if (const auto* transform = dynamic_cast<const Transform*>(node.get())) {
        auto copy = std::make_shared<Transform>(name);
        copy->setMatrix(transform->matrix());
        copy->setBeginsObject(transform->beginsObject());
        return copy;
    }
    if (const auto* choice = dynamic_cast<const Switch*>(node.get())) {
        auto copy = std::make_shared<Switch>(name);
        copy->setVisible(choice->visible());
        return copy;
    }
    if (dynamic_cast<const Group*>(node.get())) return std::make_shared<Group>(name);
    if (const auto* light = dynamic_cast<const Light*>(node.get()))
        return std::make_shared<Light>(name, light->shape(), light->luminance());
    const auto* mesh = dynamic_cast<const Mesh*>(node.get());
    if (!mesh) return nullptr;
    return name == node->name() ? node : std::make_shared<Mesh>(name, mesh->data());
}

} // namespace

NodePtr copyOf(const NodePtr& node, const std::string& name,
               const std::function<void(const NodePtr& node, const NodePtr& copy)>& made) {
    NodePtr copy = copyOfOne(node, name);
    if (!copy) return nullptr;
    made(node, copy);
    if (const auto* group = dynamic_cast<const Group*>(node.get()))
        for (const NodePtr& child : group->children())
            if (NodePtr below = copyOf(child, child->name(), made))
                static_cast<Group&>(*copy).add(std::move(below));
    return copy;
}

} // namespace penumbra
