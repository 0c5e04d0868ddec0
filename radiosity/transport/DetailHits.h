// Where indirect light varies faster than patches can tell, and what is seen from there.
#pragma once

#include "radiosity/mesh/Contact.h"
#include "radiosity/mesh/DrawnSurface.h"
#include "radiosity/mesh/NodePatches.h"
#include "radiosity/mesh/PatchSet.h"
#include "radiosity/schedule/DirtyGroups.h"
#include "radiosity/transport/DetailRays.h"
#include "radiosity/transport/PatchMatch.h"
#include "radiosity/transport/SceneChange.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace penumbra {

/// The rays of DetailGather: what those of every node meet, which vertices are in question, and
/// what theirs meet. It depends on geometry alone.
///
/// After an edit rays are traced again if they met what moved, if it is before their hits now, or
/// if their receiver lies elsewhere. The result is what a new DetailHits would find, bit for bit.
/// Of a vertex that is not in question only the first rays are kept, up to a patch's size: what is
/// farther away does not matter to it.
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

    /// Everything is dirty at first. `patches` must outlive this.
    explicit DetailHits(const PatchSet& patches);
    DetailHits(const DetailHits&) = delete;
    DetailHits& operator=(const DetailHits&) = delete;

    /// Element of a hit on something that is not as it was; its ray is dirty.
    static constexpr std::uint32_t kGone = 0x7ffffffeu;
    /// Takes over what is known of the meshing before, as far as it still holds; nothing, if work
    /// was left there. The rest is dirty. \pre nothing was done here
    /// \return one an element before: what it is called now, or kGone; empty: nothing was taken
    std::vector<std::uint32_t> takeOver(const DetailHits& before, const PatchMatch& match);

    void apply(const SceneChange& change);
    void invalidate(const Bounds& region); ///< has all that crosses a box [m, world] traced anew
    /// Does a piece of work of about `effort` rays; false: there is none left.
    bool work(std::size_t effort);
    bool done() const { return dirtyNodes_.done() && dirtyVertices_.done(); }
    /// Share of the groups of receivers that are not dirty, in [0, 1].
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
    std::span<const std::uint32_t> nodeHits(std::size_t node) const {
        return std::span(nodeHits_).subspan(node * kRays, kRays);
    }
    /// Bits: rays of a node that meet something nearer than a patch's size.
    std::uint64_t nodeNear(std::size_t node) const { return nodeNear_[node]; }
    double nodeOpenness(std::size_t node) const { return nodeOpenness_[node]; }

    std::size_t vertexCount() const; ///< that gather
    std::uint64_t rayCount() const { return rayCount_; }
    std::uint64_t groupsVisited() const { return groupsVisited_; }

private:
    /// What is known of a run of vertices.
    struct Group {
        std::uint32_t probed = 0; ///< bits: not in question, known by their first rays
        std::array<std::array<std::uint32_t, DetailRays::kProbes>, kGroup> probes;
        std::vector<Gatherer> gatherers;
        std::vector<std::uint32_t> hits; ///< kRays a gatherer, as many again in a slit
        const Gatherer* find(std::uint32_t vertex) const;
    };
    /// What became of one group.
    struct Outcome {
        std::uint64_t rays = 0;
        std::uint32_t changed = 0; ///< bits: nodes of another openness
        Bounds ways;
    };
    struct Visit;
    void takeNodes(const DetailHits& before, std::span<const std::uint32_t> were,
                   const std::vector<std::uint32_t>& elements);
    void takeVertices(const DetailHits& before, std::span<const std::uint32_t> were,
                      const std::vector<std::uint32_t>& elements);
    bool takeVertex(const Group& before, std::uint32_t was, std::uint32_t vertex,
                    const std::vector<std::uint32_t>& elements);
    void resize();
    Bounds boxOf(std::uint32_t object) const;
    DetailRays::Moved movedOf(const DirtyGroups::Dirty& dirty) const;
    bool isThere(ObjectId object) const { return patches_.objects[object.value].present; }
    void revisit(std::uint32_t index, bool slitsOnly);
    bool workOnNodes(std::size_t effort);
    bool workOnVertices(std::size_t effort);
    template <class Trace>
    bool workOn(DirtyGroups& dirty, std::size_t rays, std::size_t effort, const Trace& trace);
    Outcome traceNodes(std::uint32_t group);
    Outcome traceVertices(std::uint32_t group);
    bool anyAffected(std::uint32_t group, const DetailRays::Moved& moved) const;
    void follow(const Visit& at, Group& out, Outcome& outcome) const;
    void gather(const Visit& at, DetailRays::Hits& hits, Group& out, Outcome& outcome) const;
    glm::vec3 middleAround(std::uint32_t vertex) const;

    const PatchSet& patches_;
    DrawnSurface surface_;
    DetailRays rays_;
    Fans fans_; ///< of the shared vertices
    NodePatches nodePatches_;
    std::vector<Bounds> boxes_; ///< of objects as drawn, a hair larger; empty: not there
    DirtyGroups dirtyNodes_, dirtyVertices_;

    std::vector<std::uint32_t> nodeHits_; ///< kRays a node
    std::vector<std::uint64_t> nodeNear_;
    std::vector<double> nodeOpenness_;
    std::vector<Group> groups_;
    std::uint64_t rayCount_ = 0, groupsVisited_ = 0;
};

} // namespace penumbra
