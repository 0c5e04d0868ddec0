// Indirect light where it varies faster than patches can tell: in gaps, under things, along edges.
#pragma once

#include "base/Rgb.h"
#include "radiosity/mesh/PatchSet.h"
#include "radiosity/transport/DetailHits.h"
#include "radiosity/transport/Lighting.h"
#include "radiosity/transport/SceneChange.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace penumbra {

/// Indirect light is exchanged between patches and interpolated from their nodes to the vertices.
/// That misses shadows of indirect light that are smaller than a patch. They are found by openness,
/// the cosine-weighted share of a point's hemisphere that is free of surfaces nearer than a patch's
/// size. With H the solver's values at the nodes and G what rays over the hemisphere gather,
///
///     H_v = interpolated H + w (G_v - interpolated G)
///
/// where w rises from 0 to 1 as the vertex's openness differs from the one interpolated from the
/// nodes. Vertex and nodes use the same ray directions, so that most of the sampling error cancels;
/// directions that meet nothing near from either are left out where they face alike.
/// Where a vertex is so enclosed that near surfaces matter more than patches can tell, G itself is
/// taken.
/// In a slit narrower than an element light dies off between two vertices. There a ray that meets
/// the opposite wall is taken to find the direct light D that is drawn there and as much indirect
/// light as the vertex itself receives,
///
///     H_v = (sum of rho H over other rays + sum of rho D over rays across)
///           / (number of rays - sum of rho over rays across)
///
/// and the rays start half-way from the vertex to the middle of its elements: what the very rim
/// receives is not typical of the element.
/// Which vertices gather, with which weight and from what, is geometry alone: see DetailHits. Light
/// goes from gathering vertex to gathering vertex in sweeps, anew whenever it has changed. Until
/// these sweeps are done, vertices gather what the last ones found, along the present rays.
class DetailGather {
public:
    /// Everything is dirty at first. Both must outlive this.
    DetailGather(const PatchSet& patches, NodeHits& nodes);
    ~DetailGather();

    /// Takes over what still holds of the meshing before, and shows its light until the sweeps are
    /// done. \pre nothing was done here, and the nodes took over
    void takeOver(const DetailGather& before, const PatchMatch& match,
                  const NodeHits::Taken& taken);
    void add(std::span<const ObjectId> objects); ///< see Solver
    /// Takes note of an edit that has been made to the patch set. Traces nothing.
    /// \param moves what the nodes made of the change
    void apply(const SceneChange& change, std::span<const NodeHits::Move> moves);
    void invalidate(const Bounds& region); ///< see LitScene
    /// Light will not be quite what it is, with everything where it is: sweeps begin anew. What the
    /// last ones found stays good to within that change.
    void sweepAgain() { swept_ = sweeping_ = false; }
    /// Whether sweeps are to come before anything is known of the light after the last edit.
    bool pending() const { return pending_; }

    /// Brings rays up to date: a piece of work of about `effort` rays; false: there is none left.
    /// \pre those of the nodes are
    bool trace(std::size_t effort) { return hits_.work(effort); }
    /// Whether the sweeps know of the light as it is.
    bool swept() const { return swept_; }
    bool sweeping() const { return sweeping_; }
    /// How much of tracing and sweeps is done, in [0, 1].
    double share() const;
    /// Begins the sweeps. \pre trace() has nothing to do
    /// \param direct       at the vertices [lux]; is read until the sweeps are done or given up
    /// \param nodeIndirect the solver's, one a node of the patch set [lux]
    void beginSweeps(std::span<const Rgb> direct, std::vector<glm::dvec3> nodeIndirect);
    /// A piece of them, which costs about as much as `effort` rays. \pre sweeping()
    void sweep(std::size_t effort);

    /// Corrects the indirect light of the vertices in question within a block of
    /// PatchSet::kBlock vertices.
    /// \param nodeIndirect as above
    /// \param indirect     at all vertices: interpolated from these [lux]
    void correct(std::uint32_t block, std::span<const glm::dvec3> nodeIndirect,
                 std::span<Rgb> indirect) const;

    const DetailHits& hits() const { return hits_; }

private:
    /// What one element reflects [lm/m^2].
    struct alignas(16) Light {
        Rgb colour;
        float luminance = 0;
    };
    /// What elements reflect.
    struct Sent {
        std::vector<Light> all, direct; ///< of all light, and of direct light alone
    };
    struct Sweep;
    static Light usual(const std::vector<Light>& lights);
    /// Which rays count, and for how much.
    struct Bound {
        std::uint64_t which = ~std::uint64_t(0); ///< bits: those that count
        std::uint64_t far = 0;                   ///< bits: for `most` [lm/m^2] at the most
        float most = 0;
    };
    glm::dvec3 gathered(const Sent& sent, std::span<const std::uint32_t> hits, bool slit,
                        const Bound& bound) const;
    glm::dvec3 difference(const Sent& sent, std::span<const std::uint32_t> hits,
                          const DetailHits::Gatherer& gatherer, glm::dvec3 known) const;
    Rgb received(const Sent& sent, std::size_t group, const DetailHits::Gatherer& gatherer,
                 std::span<const glm::dvec3> nodeIndirect) const;
    void interpolateVertices(Sweep& sweep, std::size_t first, std::size_t last) const;
    void sendElements(Sweep& sweep, std::size_t first, std::size_t last) const;
    void gatherVertices(Sweep& sweep, std::size_t first, std::size_t last) const;
    void blendVertices(Sweep& sweep, std::size_t first, std::size_t last) const;
    template <class CorrectionOf>
    void blend(std::uint32_t block, std::span<Rgb> indirect,
               const CorrectionOf& correctionOf) const;

    const PatchSet& patches_;
    DetailHits hits_;
    Sent sent_; ///< as the last sweeps left it; empty before the first
    bool swept_ = false, sweeping_ = false, pending_ = true;
    std::unique_ptr<Sweep> sweep_; ///< those under way, or given up
};

} // namespace penumbra
