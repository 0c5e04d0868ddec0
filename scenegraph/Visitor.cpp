#include "scenegraph/Visitor.h"

#include "scenegraph/Transform.h"

namespace penumbra {

void Visitor::visit(const Group& group) {
    traverse(group);
}

void Visitor::visit(const Switch& node) {
    if (node.visible()) traverse(node);
}

void Visitor::visit(const Transform& transform) {
    matrices_.push_back(matrices_.back() * transform.matrix());
    traverse(transform);
    matrices_.pop_back();
}

void Visitor::traverse(const Group& group) {
    for (const NodePtr& child : group.children()) {
        nodes_.push_back(child.get());
        child->accept(*this);
        nodes_.pop_back();
    }
}

std::string Visitor::path() const {
    std::string path;
    for (const Node* node : nodes_)
        if (!node->name().empty()) path += "/" + node->name();
    return path.empty() ? "/" : path;
}

} // namespace penumbra
