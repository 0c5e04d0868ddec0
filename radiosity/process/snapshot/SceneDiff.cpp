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
    grown_ = true;
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
    if (now.beginsObject != before.beginsObject) {
        snapshot_.nodes[number].beginsObject = now.beginsObject;
        change.structure = true;
    }
    if (now.matrix != before.matrix) change.edits.push_back(SetMatrix{number, now.matrix});
    if (now.visible != before.visible) change.edits.push_back(SetVisible{number, now.visible});
    if (now.luminance != before.luminance)
        change.edits.push_back(SetLuminance{number, now.luminance});
    if (now.children != before.children) change.edits.push_back(SetChildren{number, now.children});
}

SceneDiff::Change SceneDiff::diff() {
    Change change;
    grown_ = false;
    const std::size_t known = nodes_.size();
    for (std::uint32_t n = 0; n < known; ++n)
        if (nodes_[n].node && nodes_[n].node->revision() != nodes_[n].revision) diffNode(n, change);
    for (std::uint32_t m = 0; m < materials_.size(); ++m) {
        auto& [material, revision] = materials_[m];
        if (!material || std::exchange(revision, material->revision()) == revision) continue;
        const MaterialSnapshot& reported = snapshot_.materials[m];
        (void)reported;
        change.edits.push_back(SetMaterial{m, material->reflectance(), material->emission()});
    }
    change.structure |= grown_;
    if (change.structure) {
        std::erase_if(change.edits, [&](const GraphEdit& edit) {
            return std::holds_alternative<SetChildren>(edit) && apply(snapshot_, edit);
        });
        dropUnreachable();
    }
    return change;
}

/// Forgets what has been taken out of the graph: it might be gone for good.
void SceneDiff::dropUnreachable() {
    std::vector<std::uint8_t> nodes(nodes_.size(), 0), materials(materials_.size(), 0);
    std::vector<std::uint32_t> open{0};
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
    }
    for (std::uint32_t m = 0; m < materials.size(); ++m) {
        if (materials[m] || !materials_[m].material) continue;
        materialNumbers_.erase(materials_[m].material.get());
        materials_[m] = {};
    }
}

} // namespace penumbra
