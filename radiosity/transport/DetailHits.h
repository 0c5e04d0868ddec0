// Where indirect light varies faster than patches can tell, and what is seen from there.
#pragma once

#include "radiosity/mesh/Contact.h"
#include "radiosity/mesh/NodePatches.h"
#include "radiosity/mesh/PatchSet.h"
#include "radiosity/schedule/DirtyGroups.h"
#include "radiosity/schedule/GroupWork.h"
#include "radiosity/transport/DetailRays.h"
#include "radiosity/transport/NodeHits.h"
#include "radiosity/transport/PatchMatch.h"
#include "radiosity/transport/SceneChange.h"

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

namespace penumbra {

/// Which vertices are in question, by what their rays meet and what those of their nodes do
/// (NodeHits), and what is met by rays from there. It depends on geometry alone.
///
/// Rays are followed as those of nodes are. The result is what a new DetailHits would find, bit for
/// bit. Of a vertex that is not in question only the first rays are kept, up to a patch's size:
/// what is farther away does not matter to it.
class DetailHits {
public:
    static constexpr int kRays = DetailRays::kRays;
    static constexpr std::uint32_t kGroup = DirtyGroups::kSize;

    /// A vertex in question.
    struct Gatherer {
        std::uint32_t vertex = 0;
        float detail = 0;       ///< weight of what its rays gather against what is interpolated
        float shut = 0;         ///< weight of what its rays gather instead of what patches say
        bool slit = false;      ///< light is gathered from `inside`
        std::uint64_t near = 0; ///< rays that meet something nearer than a patch's size
        glm::vec3 inside{};     ///< half-way to the middle of its elements [m, world]
        std::uint32_t first = 0;

        bool weighs() const { return detail != 0 || shut != 0; }
    };

    /// Everything is dirty at first. Both must outlive this.
    DetailHits(const PatchSet& patches, NodeHits& nodes);
    DetailHits(const DetailHits&) = delete;
    DetailHits& operator=(const DetailHits&) = delete;

    static constexpr std::uint32_t kGone = NodeHits::kGone;
    /// Takes over what is known of the meshing before, as far as it still holds; nothing, if work
    /// was left there. The rest is dirty. \pre nothing was done here, and the nodes took over
    /// \return whether anything was taken
    bool takeOver(const DetailHits& before, const PatchMatch& match, const NodeHits::Taken& taken);

    void add(std::span<const ObjectId> objects); ///< see Solver
    /// \param moves what the nodes made of the change
    void apply(const SceneChange& change, std::span<const NodeHits::Move> moves);
    void invalidate(const Bounds& region); ///< has all that crosses a box [m, world] traced anew
    /// Does a piece of work of about `effort` rays; false: there is none left.
    /// \pre nodes().done(): vertices are judged by what their nodes see
    bool work(std::size_t effort);
    bool done() const { return nodes_.done() && !nodes_.anyChanged() && dirty_.done(); }
    /// Share of the groups of vertices that are not dirty, in [0, 1].
    double share() const;

    /// Vertices in question among kGroup * group ... kGroup * (group + 1) - 1, in their order.
    std::span<const Gatherer> gatherers(std::size_t group) const {
        return groups_[group].gatherers;
    }
    std::size_t groupCount() const { return groups_.size(); }
    /// One vertex, or null: it is not in question.
    const Gatherer* gatherer(std::uint32_t vertex) const {
        return groups_[vertex / kGroup].find(vertex);
    }
    /// Element that each ray of a gatherer meets, as DetailRays::Hits has them.
    std::span<const std::uint32_t> hits(std::size_t group, const Gatherer& gatherer) const {
        return std::span(groups_[group].hits)
            .subspan(gatherer.first + (gatherer.slit ? kRays : 0), kRays);
    }
    const NodeHits& nodes() const { return nodes_; }

    std::size_t vertexCount() const;                   ///< that gather
    const GroupCount& count() const { return count_; } ///< of rays from vertices

private:
    /// What is known of a run of vertices.
    struct Group {
        using Probes = std::array<std::uint32_t, DetailRays::kProbes>;
        std::uint32_t probed = 0;   ///< bits: not in question, known by their first rays
        std::vector<Probes> probes; ///< of each of those
        std::vector<Gatherer> gatherers;
        std::vector<std::uint32_t> hits; ///< kRays a gatherer, as many again in a slit
        const Gatherer* find(std::uint32_t vertex) const;
        const Probes& probesOf(std::uint32_t slot) const {
            return probes[std::size_t(std::popcount(probed & ((1u << slot) - 1)))];
        }
        /// \pre no later slot is probed as yet
        Probes& addProbes(std::uint32_t slot) {
            probed |= 1u << slot;
            return probes.emplace_back();
        }
        /// All is found: it takes no more memory than it needs.
        void fit() { probes.shrink_to_fit(), gatherers.shrink_to_fit(), hits.shrink_to_fit(); }
    };
    struct Visit;
    void takeVertices(const DetailHits& before, std::span<const std::uint32_t> were,
                      const std::vector<std::uint32_t>& elements);
    bool takeVertex(const Group& before, std::uint32_t was, std::uint32_t vertex,
                    const std::vector<std::uint32_t>& elements);
    void resize();
    void revisit(std::uint32_t index, bool slitsOnly);
    void revisitLit(std::uint32_t index);
    void judgeChanged();
    GroupOutcome trace(std::uint32_t group);
    bool anyAffected(std::uint32_t group, const DetailRays::Moved& moved) const;
    void follow(const Visit& at, Group& out, GroupOutcome& outcome) const;
    void gather(const Visit& at, DetailRays::Hits& hits, Group& out, GroupOutcome& outcome) const;
    glm::vec3 middleAround(std::uint32_t vertex) const;

    const PatchSet& patches_;
    NodeHits& nodes_;
    const DetailRays& rays_;
    Fans fans_; ///< of the shared vertices
    NodePatches nodePatches_;
    DirtyGroups dirty_;
    std::vector<Group> groups_;
    GroupCount count_;
};

} // namespace penumbra
