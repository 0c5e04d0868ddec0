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
        bool structure = false; ///< there are new things: the snapshot is to be sent whole
        std::vector<GraphEdit> edits;
        bool any() const { return structure || !edits.empty(); }
    };
    /// What was edited since this was called last. New things, and which things there are, enter
    /// the snapshot here; other edits do when they are sent.
    Change diff();
    /// An edit goes to the worker.
    void report(const GraphEdit& edit) { apply(snapshot_, edit); }

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
    void dropUnreachable();

    std::vector<Watched> nodes_;
    std::vector<WatchedMaterial> materials_;
    std::unordered_map<const Node*, std::uint32_t> nodeNumbers_;
    std::unordered_map<const Material*, std::uint32_t> materialNumbers_;
    std::vector<NodeSnapshot>
        seen_; ///< what matters of each node at its revision; no names, meshes
    SceneSnapshot snapshot_;
    bool grown_ = false;
};

} // namespace penumbra
