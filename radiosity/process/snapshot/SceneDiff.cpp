#include "radiosity/process/snapshot/SceneDiff.h"

#include "scenegraph/Transform.h"
#include "scenegraph/Visitor.h"

#include <algorithm>

namespace penumbra {

namespace {

using Kind = NodeSnapshot::Kind;

/// What light depends on, of one node alone.
class Describer : public Visitor {
public:
    explicit Describer(NodeSnapshot& out) : out_(out) {}
    using Visitor::visit;
    void visit(const Group& node) override { group(node, Kind::group); }
    void visit(const Switch& node) override {
        group(node, Kind::choice);
        out_.visible = node.visible();
    }
    void visit(const Transform& node) override {
        group(node, Kind::transform);
        out_.matrix = node.matrix();
        out_.beginsObject = node.beginsObject();
    }
    void visit(const Mesh& node) override {
        out_.kind = Kind::mesh;
        mesh = &node;
    }
    void visit(const Light& node) override {
        out_.kind = Kind::light;
        out_.shape = node.shape();
        out_.luminance = node.luminance();
    }

    const Group* parent = nullptr; ///< if it may have children
    const Mesh* mesh = nullptr;

private:
    void group(const Group& node, Kind kind) {
        if (parent) return; // a RadiosityNode shows its lit branch as well
        out_.kind = kind;
        parent = &node;
    }
    NodeSnapshot& out_;
};

} // namespace

SceneDiff::SceneDiff(const Group& root) {
    enter(NodePtr(NodePtr(), const_cast<Group*>(&root))); // owns nothing: it would own itself
}

std::optional<std::uint32_t> SceneDiff::numberOf(const Node& node) const {
    const auto found = nodeNumbers_.find(&node);
    if (found == nodeNumbers_.end()) return std::nullopt;
    return found->second;
}

const Node* SceneDiff::node(std::uint32_t number) const {
    return number < nodes_.size() ? nodes_[number].node.get() : nullptr;
}

const Material* SceneDiff::material(std::uint32_t number) const {
    return number < materials_.size() ? materials_[number].material.get() : nullptr;
}

std::uint32_t SceneDiff::enter(const NodePtr& node) {
    const auto number = std::uint32_t(nodes_.size());
    const auto [place, fresh] = nodeNumbers_.emplace(node.get(), number);
    if (!fresh) return place->second;
    nodes_.push_back({node, 0});
    seen_.emplace_back();
    snapshot_.nodes.emplace_back();
    snapshot_.nodes[number].name = node->name();
    describe(number);
    NodeSnapshot& snapshot = snapshot_.nodes[number];
    const NodeSnapshot& seen = seen_[number];
    snapshot.kind = number == 0 ? Kind::group : seen.kind;
    snapshot.children = seen.children;
    snapshot.visible = seen.visible;
    snapshot.beginsObject = seen.beginsObject;
    snapshot.matrix = seen.matrix;
    snapshot.shape = seen.shape;
    snapshot.luminance = seen.luminance;
    return number;
}

std::uint32_t SceneDiff::enter(const std::shared_ptr<Material>& material) {
    const auto number = std::uint32_t(materials_.size());
    const auto [place, fresh] = materialNumbers_.emplace(material.get(), number);
    if (!fresh) return place->second;
    materials_.push_back({material, material->revision()});
    snapshot_.materials.push_back(
        {material->name(), material->reflectance(), material->emission(), material->textures()});
    return number;
}

std::vector<std::uint32_t> SceneDiff::enterChildren(const Group& group) {
    std::vector<std::uint32_t> numbers;
    for (const NodePtr& child : group.children()) numbers.push_back(enter(child));
    return numbers;
}

/// Fills in seen_[number] with how the node is now.
void SceneDiff::describe(std::uint32_t number) {
    const Node& node = *nodes_[number].node;
    nodes_[number].revision = node.revision();
    NodeSnapshot now;
    Describer describer(now);
    node.accept(describer);
    if (now.kind == Kind::none) now.kind = Kind::group; // a camera, say: nothing to light
    if (describer.parent) now.children = enterChildren(*describer.parent);
    if (describer.mesh && snapshot_.nodes[number].mesh == nullptr) {
        const auto owner = std::static_pointer_cast<const Mesh>(nodes_[number].node);
        snapshot_.nodes[number].mesh = {owner, &owner->data()};
        for (const auto& material : owner->data().materials)
            snapshot_.nodes[number].materials.push_back(enter(material));
    }
    seen_[number] = std::move(now); // entering children may have moved it
}

void SceneDiff::diffNode(std::uint32_t number, Change& change) {
    const NodeSnapshot before = seen_[number];
    describe(number);
    const NodeSnapshot& now = seen_[number];
    if (now.beginsObject != before.beginsObject)
        change.edits.push_back(SetBeginsObject{number, now.beginsObject});
    if (now.matrix != before.matrix) change.edits.push_back(SetMatrix{number, now.matrix});
    if (now.visible != before.visible) change.edits.push_back(SetVisible{number, now.visible});
    if (now.luminance != before.luminance)
        change.edits.push_back(SetLuminance{number, now.luminance});
    if (now.children != before.children) change.edits.push_back(SetChildren{number, now.children});
}

SceneDiff::Change SceneDiff::diff() {
    Change change;
    const std::size_t known = nodes_.size(), knownMaterials = materials_.size();
    for (std::uint32_t n = 0; n < known; ++n)
        if (nodes_[n].node && nodes_[n].node->revision() != nodes_[n].revision) diffNode(n, change);
    for (std::uint32_t m = 0; m < knownMaterials; ++m) {
        auto& [material, revision] = materials_[m];
        if (!material || std::exchange(revision, material->revision()) == revision) continue;
        change.edits.push_back(SetMaterial{m, material->reflectance(), material->emission()});
    }
    if (nodes_.size() > known) change.growth = takeGrowth(known, knownMaterials, change);
    return change;
}

/// \param nodes, materials as many there were before; the others have come
SceneGrowth SceneDiff::takeGrowth(std::size_t nodes, std::size_t materials, Change& change) {
    SceneGrowth growth;
    growth.firstNode = std::uint32_t(nodes);
    growth.firstMaterial = std::uint32_t(materials);
    std::erase_if(change.edits, [&](const GraphEdit& edit) {
        const auto* const children = std::get_if<SetChildren>(&edit);
        if (!children || !report(edit)) return false;
        growth.children.push_back(*children);
        return true;
    });
    growth.gone = dropUnreachable();
    std::erase_if(growth.gone, [&](std::uint32_t n) { return n >= nodes; });
    growth.nodes.assign(snapshot_.nodes.begin() + std::ptrdiff_t(nodes), snapshot_.nodes.end());
    growth.materials.assign(snapshot_.materials.begin() + std::ptrdiff_t(materials),
                            snapshot_.materials.end());
    return growth;
}

/// Forgets what has been taken out of the graph: it might be gone for good. \return such nodes
std::vector<std::uint32_t> SceneDiff::dropUnreachable() {
    std::vector<std::uint8_t> nodes(nodes_.size(), 0), materials(materials_.size(), 0);
    std::vector<std::uint32_t> open{0}, gone;
    nodes[0] = 1;
    while (!open.empty()) {
        const NodeSnapshot& snapshot = snapshot_.nodes[open.back()];
        open.pop_back();
        for (std::uint32_t material : snapshot.materials) materials[material] = 1;
        for (std::uint32_t child : snapshot.children)
            if (!std::exchange(nodes[child], 1)) open.push_back(child);
    }
    for (std::uint32_t n = 0; n < nodes.size(); ++n) {
        if (nodes[n] || !nodes_[n].node) continue;
        nodeNumbers_.erase(nodes_[n].node.get());
        nodes_[n] = {};
        seen_[n] = {};
        snapshot_.nodes[n] = {};
        gone.push_back(n);
    }
    for (std::uint32_t m = 0; m < materials.size(); ++m) {
        if (materials[m] || !materials_[m].material) continue;
        materialNumbers_.erase(materials_[m].material.get());
        materials_[m] = {};
        snapshot_.materials[m].textures = {};
    }
    return gone;
}

} // namespace penumbra
