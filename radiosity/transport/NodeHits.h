// What is seen from the nodes of the indirect light.
#pragma once

#include "radiosity/mesh/PatchSet.h"
#include "radiosity/rays/RayScene.h"
#include "radiosity/schedule/DirtyGroups.h"
#include "radiosity/schedule/GroupWork.h"
#include "radiosity/transport/DetailRays.h"
#include "radiosity/transport/PatchMatch.h"
#include "radiosity/transport/SceneChange.h"

#include <cstdint>
#include <span>
#include <vector>

namespace penumbra {

/// What rays over the hemisphere of every node meet. It depends on geometry alone, says where light
/// can get to (Reach), and which vertices see less or more than their nodes (DetailHits).
///
/// After an edit rays are traced again if they met what moved, if it is before their hits now, or
/// if their node lies elsewhere. The result is what a new NodeHits would find, bit for bit.
class NodeHits {
public:
    static constexpr int kRays = DetailRays::kRays;
    static constexpr std::uint32_t kGroup = DirtyGroups::kSize;
    /// Element of a hit on something that is not as it was; its ray is dirty.
    static constexpr std::uint32_t kGone = 0x7ffffffeu;

    /// Everything is dirty at first. \param rays through all that is there; both must outlive this
    NodeHits(const PatchSet& patches, const RayScene& rays);
    NodeHits(const NodeHits&) = delete;
    NodeHits& operator=(const NodeHits&) = delete;

    /// An object that is drawn elsewhere than before, or comes or goes.
    struct Move {
        std::uint32_t object = 0;
        Bounds before, now; ///< as drawn, a hair larger; empty: not there [m, world]
    };
    /// How one meshing goes over into another.
    struct Taken {
        /// One an element before: what it is called now, or kGone.
        std::vector<std::uint32_t> elements;
        std::vector<Move> moves;
    };
    /// Takes over what is known of the meshing before, as far as it still holds. The rest is dirty.
    /// \pre nothing was done here
    Taken takeOver(const NodeHits& before, const PatchMatch& match);

    void add(); ///< takes in objects that came to the patch set, hidden
    /// Takes note of an edit that has been made to the patch set. Traces nothing.
    std::vector<Move> apply(const SceneChange& change);
    void invalidate(const Bounds& region); ///< has all that crosses a box [m, world] traced anew
    /// Does a piece of work of about `effort` rays; false: there is none left.
    bool work(std::size_t effort);
    bool done() const { return dirty_.done(); }
    /// Share of the groups of nodes that are not dirty, in [0, 1].
    double share() const;

    /// Element that each ray of a node meets, Element::kNone: nothing.
    std::span<const std::uint32_t> hits(std::size_t node) const {
        return std::span(hits_).subspan(node * kRays, kRays);
    }
    /// Bits: rays of a node that meet something nearer than a patch's size.
    std::uint64_t near(std::size_t node) const { return near_[node]; }
    /// Share of its rays that do not.
    std::span<const double> openness() const { return openness_; }
    double openness(std::size_t node) const { return openness_[node]; }

    /// Rises whenever a ray meets something else than before.
    std::uint64_t revision() const { return revision_; }
    /// Nodes of another openness than when this was called last, each once.
    std::vector<std::uint32_t> takeChanged();
    bool anyChanged() const { return !changed_.empty(); }

    const DetailRays& rays() const { return rays_; }
    /// What may have changed for a dirty group.
    DetailRays::Moved movedOf(const DirtyGroups::Dirty& dirty) const;
    bool isThere(ObjectId object) const { return patches_.objects[object.value].present; }

    std::size_t groupCount() const { return dirty_.size(); }
    const GroupCount& count() const { return count_; }

private:
    void resize();
    Bounds boxOf(std::uint32_t object) const;
    void takeNodes(const NodeHits& before, std::span<const std::uint32_t> were,
                   const std::vector<std::uint32_t>& elements);
    GroupOutcome trace(std::uint32_t group);

    const PatchSet& patches_;
    DetailRays rays_;
    std::vector<Bounds> boxes_; ///< of objects, see Move
    DirtyGroups dirty_;

    std::vector<std::uint32_t> hits_; ///< kRays a node
    std::vector<std::uint64_t> near_;
    std::vector<double> openness_;
    std::vector<std::uint32_t> changed_; ///< see takeChanged()
    std::vector<std::uint8_t> isChanged_;
    std::uint64_t revision_ = 0;
    GroupCount count_;
};

/// What a hit of the meshing before is called now. \param elements see NodeHits::Taken
std::uint32_t renamedHit(std::uint32_t hit, const std::vector<std::uint32_t>& elements);

} // namespace penumbra
