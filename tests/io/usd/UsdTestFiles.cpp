#include "tests/io/usd/UsdTestFiles.h"

#include "scenegraph/Transform.h"
#include "scenegraph/Visitor.h"

#include <cstdlib>

namespace penumbra {

namespace fs = std::filesystem;

std::optional<fs::path> sharedFolder() {
    const char* named = std::getenv("PENUMBRA_SHARED");
    const fs::path folder = named ? fs::path(named) : fs::path(PENUMBRA_SOURCE_DIR) / "../shared";
    if (!fs::is_directory(folder / "assets")) return std::nullopt;
    return folder;
}

LoadedScene loadText(const std::string& text, const LoadOptions& options) {
    const TemporaryFolder folder;
    return loadUsdScene(folder.write("scene.usda", "#usda 1.0\n" + text), options);
}

namespace {

class Lister : public Visitor {
public:
    std::map<std::string, PlacedNode> nodes;

    using Visitor::visit;
    void visit(const Group& group) override {
        add(group, toWorld());
        Visitor::visit(group);
    }
    void visit(const Transform& transform) override {
        add(transform, toWorld() * transform.matrix());
        Visitor::visit(transform);
    }
    void visit(const Mesh& mesh) override { add(mesh, toWorld()); }
    void visit(const Light& light) override { add(light, toWorld()); }
    void visit(const Camera& camera) override { add(camera, toWorld()); }

private:
    void add(const Node& node, const glm::dmat4& matrix) { nodes[path()] = {&node, matrix}; }
};

} // namespace

std::map<std::string, PlacedNode> nodesByPath(const Scene& scene) {
    Lister lister;
    scene.root->accept(lister);
    return std::move(lister.nodes);
}

const PlacedNode* leafOf(const std::map<std::string, PlacedNode>& nodes, const std::string& path) {
    const auto found = nodes.find(path);
    if (found == nodes.end()) return nullptr;
    const PlacedNode& placed = found->second;
    return placed.mesh() || placed.light() || placed.camera() ? &placed : nullptr;
}

std::size_t countOf(const LoadedScene& loaded, const std::string& text) {
    std::size_t count = 0;
    for (const Diagnostic& d : loaded.diagnostics)
        if (d.text.find(text) != std::string::npos) count += d.count;
    return count;
}

double surfaceArea(const Mesh& mesh, const glm::dmat4& toWorld) {
    const MeshData& data = mesh.data();
    double sum = 0;
    std::size_t offset = 0;
    for (const std::int32_t count : data.faceVertexCounts) {
        const auto corner = [&](std::int32_t i) {
            const std::int32_t index = data.faceVertexIndices[offset + std::size_t(i)];
            return glm::dmat3(toWorld) * glm::dvec3(data.points[std::size_t(index)]);
        };
        glm::dvec3 normal(0);
        for (std::int32_t i = 1; i + 1 < count; ++i)
            normal += glm::cross(corner(i) - corner(0), corner(i + 1) - corner(0));
        sum += glm::length(normal) / 2;
        offset += std::size_t(count);
    }
    return sum;
}

} // namespace penumbra
