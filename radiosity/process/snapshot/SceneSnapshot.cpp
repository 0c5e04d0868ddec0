#include "radiosity/process/snapshot/SceneSnapshot.h"

#include <algorithm>
#include <cmath>

namespace penumbra {

namespace {

using Kind = NodeSnapshot::Kind;

bool finite(const glm::dmat4& matrix) {
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            if (!std::isfinite(matrix[column][row])) return false;
    return true;
}

bool isLight(Rgb c) {
    const auto good = [](float v) { return std::isfinite(v) && v >= 0; };
    return good(c.r) && good(c.g) && good(c.b);
}

bool hasChildren(Kind kind) {
    return kind == Kind::group || kind == Kind::choice || kind == Kind::transform;
}

bool known(const SceneSnapshot& snapshot, const std::vector<std::uint32_t>& nodes) {
    return std::all_of(nodes.begin(), nodes.end(), [&](std::uint32_t n) {
        return n < snapshot.nodes.size() && snapshot.nodes[n].kind != Kind::none;
    });
}

NodeSnapshot* node(SceneSnapshot& snapshot, std::uint32_t number, Kind kind) {
    if (number >= snapshot.nodes.size() || snapshot.nodes[number].kind != kind) return nullptr;
    return &snapshot.nodes[number];
}

struct Applier {
    SceneSnapshot& snapshot;

    bool operator()(const SetMatrix& edit) const {
        NodeSnapshot* const found = node(snapshot, edit.node, Kind::transform);
        if (!found || !finite(edit.matrix)) return false;
        found->matrix = edit.matrix;
        return true;
    }
    bool operator()(const SetVisible& edit) const {
        NodeSnapshot* const found = node(snapshot, edit.node, Kind::choice);
        if (!found) return false;
        found->visible = edit.visible;
        return true;
    }
    bool operator()(const SetLuminance& edit) const {
        NodeSnapshot* const found = node(snapshot, edit.node, Kind::light);
        if (!found || !isLight(edit.luminance)) return false;
        found->luminance = edit.luminance;
        return true;
    }
    bool operator()(const SetMaterial& edit) const {
        if (edit.material >= snapshot.materials.size() || !isLight(edit.reflectance) ||
            !isLight(edit.emission))
            return false;
        snapshot.materials[edit.material].reflectance = edit.reflectance;
        snapshot.materials[edit.material].emission = edit.emission;
        return true;
    }
    bool operator()(const SetChildren& edit) const {
        if (edit.node >= snapshot.nodes.size() || !hasChildren(snapshot.nodes[edit.node].kind) ||
            !known(snapshot, edit.children))
            return false;
        auto before = std::exchange(snapshot.nodes[edit.node].children, edit.children);
        if (walkable(snapshot)) return true;
        snapshot.nodes[edit.node].children = std::move(before);
        return false;
    }
    bool operator()(const SetBeginsObject& edit) const {
        NodeSnapshot* const found = node(snapshot, edit.node, Kind::transform);
        if (!found) return false;
        found->beginsObject = edit.beginsObject;
        return true;
    }
};

} // namespace

std::uint64_t keyOf(const GraphEdit& edit) {
    struct Target {
        std::uint32_t operator()(const SetMatrix& e) const { return e.node; }
        std::uint32_t operator()(const SetVisible& e) const { return e.node; }
        std::uint32_t operator()(const SetLuminance& e) const { return e.node; }
        std::uint32_t operator()(const SetMaterial& e) const { return e.material; }
        std::uint32_t operator()(const SetChildren& e) const { return e.node; }
        std::uint32_t operator()(const SetBeginsObject& e) const { return e.node; }
    };
    return std::uint64_t(edit.index()) << 32 | std::visit(Target{}, edit);
}

bool apply(SceneSnapshot& snapshot, const GraphEdit& edit) {
    return std::visit(Applier{snapshot}, edit);
}

bool apply(SceneSnapshot& snapshot, const SceneGrowth& growth) {
    std::vector<NodeSnapshot>& nodes = snapshot.nodes;
    if (growth.firstNode != nodes.size() || growth.firstMaterial != snapshot.materials.size())
        return false;
    nodes.insert(nodes.end(), growth.nodes.begin(), growth.nodes.end());
    snapshot.materials.insert(snapshot.materials.end(), growth.materials.begin(),
                              growth.materials.end());
    for (const SetChildren& edit : growth.children) {
        if (edit.node >= nodes.size() || !hasChildren(nodes[edit.node].kind)) return false;
        nodes[edit.node].children = edit.children;
    }
    for (const std::uint32_t gone : growth.gone) {
        if (gone >= nodes.size()) return false;
        nodes[gone] = {};
    }
    return makesSense(snapshot);
}

bool makesSense(const SceneSnapshot& snapshot) {
    const bool nodes = std::ranges::all_of(snapshot.nodes, [&](const NodeSnapshot& node) {
        return (node.kind != Kind::transform || finite(node.matrix)) &&
               (node.kind != Kind::light || isLight(node.luminance)) &&
               known(snapshot, node.children) &&
               std::ranges::all_of(node.materials, [&](std::uint32_t material) {
                   return material < snapshot.materials.size();
               });
    });
    return nodes && walkable(snapshot) &&
           std::ranges::all_of(snapshot.materials, [](const MaterialSnapshot& material) {
               return isLight(material.reflectance) && isLight(material.emission);
           });
}

bool walkable(const SceneSnapshot& snapshot) {
    constexpr std::uint64_t kMostPaths = 50'000'000;
    constexpr std::size_t kDeepest = 5000; // visitors call themselves
    if (snapshot.nodes.empty() || snapshot.nodes[0].kind != Kind::group) return false;
    // Depth first with a stack of one's own; paths and depth below a node are known when it is
    // left.
    enum : std::uint8_t { fresh, open, done };
    std::vector<std::uint8_t> state(snapshot.nodes.size(), fresh);
    std::vector<std::uint64_t> paths(snapshot.nodes.size(), 0), depth(snapshot.nodes.size(), 0);
    std::vector<std::pair<std::uint32_t, std::size_t>> stack{{0u, 0u}};
    state[0] = open;
    while (!stack.empty()) {
        auto& [at, next] = stack.back();
        const std::vector<std::uint32_t>& children = snapshot.nodes[at].children;
        if (next == children.size()) {
            paths[at] = 1, depth[at] = 1;
            for (std::uint32_t child : children) {
                paths[at] = std::min(kMostPaths + 1, paths[at] + paths[child]);
                depth[at] = std::max(depth[at], depth[child] + 1);
            }
            if (paths[at] > kMostPaths || depth[at] > kDeepest) return false;
            state[at] = done;
            stack.pop_back();
            continue;
        }
        const std::uint32_t child = children[next++];
        if (state[child] == open) return false;
        if (state[child] == done) continue;
        state[child] = open;
        stack.push_back({child, 0u});
    }
    return true;
}

} // namespace penumbra
