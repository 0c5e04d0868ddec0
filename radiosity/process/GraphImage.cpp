#include "radiosity/process/GraphImage.h"

#include <algorithm>
#include <cmath>

namespace penumbra {

namespace {

using Kind = NodeImage::Kind;

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

bool known(const GraphImage& image, const std::vector<std::uint32_t>& nodes) {
    return std::all_of(nodes.begin(), nodes.end(), [&](std::uint32_t n) {
        return n < image.nodes.size() && image.nodes[n].kind != Kind::none;
    });
}

NodeImage* node(GraphImage& image, std::uint32_t number, Kind kind) {
    if (number >= image.nodes.size() || image.nodes[number].kind != kind) return nullptr;
    return &image.nodes[number];
}

struct Applier {
    GraphImage& image;

    bool operator()(const SetMatrix& edit) const {
        NodeImage* const found = node(image, edit.node, Kind::transform);
        if (!found || !finite(edit.matrix)) return false;
        found->matrix = edit.matrix;
        return true;
    }
    bool operator()(const SetVisible& edit) const {
        NodeImage* const found = node(image, edit.node, Kind::choice);
        if (!found) return false;
        found->visible = edit.visible;
        return true;
    }
    bool operator()(const SetLuminance& edit) const {
        NodeImage* const found = node(image, edit.node, Kind::light);
        if (!found || !isLight(edit.luminance)) return false;
        found->luminance = edit.luminance;
        return true;
    }
    bool operator()(const SetMaterial& edit) const {
        if (edit.material >= image.materials.size() || !isLight(edit.reflectance) ||
            !isLight(edit.emission))
            return false;
        image.materials[edit.material].reflectance = edit.reflectance;
        image.materials[edit.material].emission = edit.emission;
        return true;
    }
    bool operator()(const SetChildren& edit) const {
        if (edit.node >= image.nodes.size() || !hasChildren(image.nodes[edit.node].kind) ||
            !known(image, edit.children))
            return false;
        auto before = std::exchange(image.nodes[edit.node].children, edit.children);
        if (walkable(image)) return true;
        image.nodes[edit.node].children = std::move(before);
        return false;
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
    };
    return std::uint64_t(edit.index()) << 32 | std::visit(Target{}, edit);
}

bool apply(GraphImage& image, const GraphEdit& edit) {
    return std::visit(Applier{image}, edit);
}

bool walkable(const GraphImage& image) {
    constexpr std::uint64_t kMostPaths = 50'000'000;
    constexpr std::size_t kDeepest = 5000; // visitors call themselves
    if (image.nodes.empty() || image.nodes[0].kind != Kind::group) return false;
    // Depth first with a stack of one's own; paths and depth below a node are known when it is
    // left.
    enum : std::uint8_t { fresh, open, done };
    std::vector<std::uint8_t> state(image.nodes.size(), fresh);
    std::vector<std::uint64_t> paths(image.nodes.size(), 0), depth(image.nodes.size(), 0);
    std::vector<std::pair<std::uint32_t, std::size_t>> stack{{0u, 0u}};
    state[0] = open;
    while (!stack.empty()) {
        auto& [at, next] = stack.back();
        const std::vector<std::uint32_t>& children = image.nodes[at].children;
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
