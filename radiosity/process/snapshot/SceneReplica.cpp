#include "radiosity/process/snapshot/SceneReplica.h"

#include "scenegraph/Transform.h"

namespace penumbra {

namespace {
using Kind = NodeSnapshot::Kind;
}

SceneReplica::SceneReplica(SceneSnapshot snapshot) : snapshot_(std::move(snapshot)) {
    makeThings(0, 0);
    scene_.root = std::static_pointer_cast<Group>(nodes_[0]);
}

/// Makes the materials and nodes of the snapshot from these on.
void SceneReplica::makeThings(std::size_t firstMaterial, std::size_t firstNode) {
    for (std::size_t m = firstMaterial; m < snapshot_.materials.size(); ++m) {
        const MaterialSnapshot& from = snapshot_.materials[m];
        const auto material = std::make_shared<Material>(from.name, from.textures);
        material->setReflectance(from.reflectance);
        material->setEmission(from.emission);
        materials_.push_back(material);
        numbers_[material.get()] = std::uint32_t(m);
    }
    for (std::size_t n = firstNode; n < snapshot_.nodes.size(); ++n) {
        nodes_.push_back(makeNode(snapshot_.nodes[n]));
        if (nodes_[n]) numbers_[nodes_[n].get()] = std::uint32_t(n);
        snapshot_.nodes[n].mesh.reset();
    }
    for (std::size_t n = firstNode; n < nodes_.size(); ++n)
        if (nodes_[n]) adopt(std::uint32_t(n));
}

NodePtr SceneReplica::makeNode(const NodeSnapshot& snapshot) const {
    switch (snapshot.kind) {
    case Kind::none:
        return nullptr;
    case Kind::group:
        return std::make_shared<Group>(snapshot.name);
    case Kind::choice: {
        auto node = std::make_shared<Switch>(snapshot.name);
        node->setVisible(snapshot.visible);
        return node;
    }
    case Kind::transform: {
        auto node = std::make_shared<Transform>(snapshot.name);
        node->setMatrix(snapshot.matrix);
        node->setBeginsObject(snapshot.beginsObject);
        return node;
    }
    case Kind::light:
        return std::make_shared<Light>(snapshot.name, snapshot.shape, snapshot.luminance);
    case Kind::mesh: {
        MeshData mesh = *snapshot.mesh;
        mesh.materials.clear();
        for (std::uint32_t material : snapshot.materials)
            mesh.materials.push_back(materials_[material]);
        return std::make_shared<Mesh>(snapshot.name, std::move(mesh));
    }
    }
    return nullptr;
}

/// Gives a node the children that the snapshot says.
void SceneReplica::adopt(std::uint32_t node) {
    auto* const group = dynamic_cast<Group*>(nodes_[node].get());
    if (!group) return;
    while (!group->children().empty()) group->remove(NodePtr(group->children().back()));
    for (std::uint32_t child : snapshot_.nodes[node].children) group->add(nodes_[child]);
}

/// Edits the nodes as the snapshot was edited, so that both say the same.
struct SceneReplica::Editor {
    SceneReplica& copy;

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
    void operator()(const SetBeginsObject& e) const {
        node<Transform>(e.node).setBeginsObject(e.beginsObject);
    }
};

bool SceneReplica::apply(const GraphEdit& edit) {
    if (!penumbra::apply(snapshot_, edit)) return false;
    std::visit(Editor{*this}, edit);
    return true;
}

bool SceneReplica::apply(const SceneGrowth& growth) {
    if (!penumbra::apply(snapshot_, growth)) return false;
    makeThings(growth.firstMaterial, growth.firstNode);
    for (const SetChildren& edit : growth.children)
        if (nodes_[edit.node]) adopt(edit.node);
    for (const std::uint32_t gone : growth.gone) {
        numbers_.erase(nodes_[gone].get());
        nodes_[gone].reset();
    }
    return true;
}

std::uint32_t SceneReplica::numberOf(const Material* material) const {
    const auto found = numbers_.find(material);
    return found == numbers_.end() ? kNone : found->second;
}

std::uint32_t SceneReplica::numberOf(const Node* node) const {
    const auto found = numbers_.find(node);
    return found == numbers_.end() ? kNone : found->second;
}

} // namespace penumbra
