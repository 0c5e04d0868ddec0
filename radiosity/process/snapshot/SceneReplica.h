// A scene graph made from a snapshot, to which edits are applied.
#pragma once

#include "radiosity/process/snapshot/SceneSnapshot.h"
#include "scenegraph/Scene.h"

#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

namespace penumbra {

/// The worker's own graph.
class SceneReplica {
public:
    explicit SceneReplica(SceneSnapshot snapshot);

    /// \return whether it can be done, see apply()
    bool apply(const GraphEdit& edit);
    bool apply(const SceneGrowth& growth);

    const Scene& scene() const { return scene_; }
    /// Numbers in the snapshot; kNone: it is none of these.
    std::uint32_t numberOf(const Material* material) const;
    std::uint32_t numberOf(const Node* node) const;
    static constexpr std::uint32_t kNone = 0xffffffffu;

private:
    struct Editor;
    void makeThings(std::size_t firstMaterial, std::size_t firstNode);
    NodePtr makeNode(const NodeSnapshot& snapshot) const;
    void adopt(std::uint32_t node);

    SceneSnapshot snapshot_; ///< without the meshes
    Scene scene_;
    std::vector<std::shared_ptr<Material>> materials_;
    std::vector<NodePtr> nodes_;
    std::unordered_map<const void*, std::uint32_t> numbers_;
};

} // namespace penumbra
