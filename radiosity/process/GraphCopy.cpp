#include "radiosity/process/GraphCopy.h"

#include "scenegraph/Transform.h"

namespace penumbra {

namespace {
using Kind = NodeImage::Kind;
}

GraphCopy::GraphCopy(GraphImage image) : image_(std::move(image)) {
    for (std::uint32_t m = 0; m < image_.materials.size(); ++m) {
        const MaterialImage& from = image_.materials[m];
        const auto material = std::make_shared<Material>(from.name);
        material->setReflectance(from.reflectance);
        material->setEmission(from.emission);
        materials_.push_back(material);
        numbers_[material.get()] = m;
    }
    for (std::uint32_t n = 0; n < image_.nodes.size(); ++n) {
        nodes_.push_back(makeNode(image_.nodes[n]));
        if (nodes_[n]) numbers_[nodes_[n].get()] = n;
        image_.nodes[n].mesh.reset();
    }
    for (std::uint32_t n = 0; n < nodes_.size(); ++n)
        if (nodes_[n]) adopt(n);
    scene_.root = std::static_pointer_cast<Group>(nodes_[0]);
}

NodePtr GraphCopy::makeNode(const NodeImage& image) const {
    switch (image.kind) {
    case Kind::none:
        return nullptr;
    case Kind::group:
        return std::make_shared<Group>(image.name);
    case Kind::choice: {
        auto node = std::make_shared<Switch>(image.name);
        node->setVisible(image.visible);
        return node;
    }
    case Kind::transform: {
        auto node = std::make_shared<Transform>(image.name);
        node->setMatrix(image.matrix);
        node->setMovable(image.movable);
        return node;
    }
    case Kind::light:
        return std::make_shared<Light>(image.name, image.shape, image.luminance);
    case Kind::mesh: {
        MeshData mesh = *image.mesh;
        mesh.materials.clear();
        for (std::uint32_t material : image.materials)
            mesh.materials.push_back(materials_[material]);
        return std::make_shared<Mesh>(image.name, std::move(mesh));
    }
    }
    return nullptr;
}

/// Gives a node the children that the image says.
void GraphCopy::adopt(std::uint32_t node) {
    auto* const group = dynamic_cast<Group*>(nodes_[node].get());
    if (!group) return;
    while (!group->children().empty()) group->remove(NodePtr(group->children().back()));
    for (std::uint32_t child : image_.nodes[node].children) group->add(nodes_[child]);
}

/// Edits the nodes as the image was edited, so that both say the same.
struct GraphCopy::Editor {
    GraphCopy& copy;

    template <class T>
    T& node(std::uint32_t number) const {
        return static_cast<T&>(*copy.nodes_[number]);
    }
    void operator()(const SetMatrix& e) const { node<Transform>(e.node).setMatrix(e.matrix); }
    void operator()(const SetVisible& e) const { node<Switch>(e.node).setVisible(e.visible); }
    void operator()(const SetLuminance& e) const { node<Light>(e.node).setLuminance(e.luminance); }
    void operator()(const SetMaterial& e) const {
        copy.materials_[e.material]->setReflectance(e.reflectance);
        copy.materials_[e.material]->setEmission(e.emission);
    }
    void operator()(const SetChildren& e) const { copy.adopt(e.node); }
};

bool GraphCopy::apply(const GraphEdit& edit) {
    if (!penumbra::apply(image_, edit)) return false;
    std::visit(Editor{*this}, edit);
    return true;
}

std::uint32_t GraphCopy::numberOf(const Material* material) const {
    const auto found = numbers_.find(material);
    return found == numbers_.end() ? kNone : found->second;
}

std::uint32_t GraphCopy::numberOf(const Node* node) const {
    const auto found = numbers_.find(node);
    return found == numbers_.end() ? kNone : found->second;
}

} // namespace penumbra
