// The graph below a node, watched for edits.
#pragma once

#include "radiosity/process/snapshot/SceneSnapshot.h"
#include "scenegraph/Group.h"

#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

namespace penumbra {

/// Gives numbers to the nodes and materials of a graph, and finds what was edited by their
/// revisions. Beside the graph as it is it keeps a snapshot of what was sent to the worker:
/// a new worker gets this snapshot, and has missed nothing.
class SceneDiff {
public:
    /// \param root must outlive this
    explicit SceneDiff(const Group& root);

    struct Change {
        std::optional<SceneGrowth> growth; ///< comes before the edits
        std::vector<GraphEdit> edits;
        bool any() const { return growth || !edits.empty(); }
    };
    /// What was edited since this was called last. New things enter the snapshot here, and with
    /// them which things there are; other edits do when they are sent.
    Change diff();
    /// An edit goes to the worker.
    /// \return false: what it is of is there no more
    bool report(const GraphEdit& edit) { return apply(snapshot_, edit); }

    const SceneSnapshot& snapshot() const { return snapshot_; }
    std::optional<std::uint32_t> numberOf(const Node& node) const;
    /// The thing of a number, null: none.
    const Node* node(std::uint32_t number) const;
    const Material* material(std::uint32_t number) const;

private:
    struct Watched {
        NodePtr node; ///< held, so that no other node gets its address
        std::uint64_t revision = 0;
    };
    struct WatchedMaterial {
        std::shared_ptr<Material> material;
        std::uint64_t revision = 0;
    };
    std::uint32_t enter(const NodePtr& node);
    std::uint32_t enter(const std::shared_ptr<Material>& material);
    std::vector<std::uint32_t> enterChildren(const Group& group);
    void describe(std::uint32_t number);
    void diffNode(std::uint32_t number, Change& change);
    SceneGrowth takeGrowth(std::size_t nodes, std::size_t materials, Change& change);
    std::vector<std::uint32_t> dropUnreachable();

    std::vector<Watched> nodes_;
    std::vector<WatchedMaterial> materials_;
    std::unordered_map<const Node*, std::uint32_t> nodeNumbers_;
    std::unordered_map<const Material*, std::uint32_t> materialNumbers_;
    std::vector<NodeSnapshot>
        seen_; ///< what matters of each node at its revision; no names, meshes
    SceneSnapshot snapshot_;
};

} // namespace penumbra
