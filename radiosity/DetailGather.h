// Indirect light where it varies faster than patches can tell: in gaps, under things, along edges.
#pragma once

#include "radiosity/PatchSet.h"
#include "radiosity/Solver.h"

#include <cstdint>
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
/// nodes. Vertex and nodes use the same ray directions, so that most of the sampling error cancels.
/// Where so little is open that near surfaces matter more than patches can tell, G itself is taken.
/// In a slit narrower than an element light dies off between two vertices. There a ray that meets
/// the other side is taken to find the direct light D that is drawn there and as much indirect
/// light as the vertex itself receives,
///
///     H_v = (sum of rho H over other rays + sum of rho D over rays across)
///           / (number of rays - sum of rho over rays across)
///
/// and the rays start on half the way from the vertex to the middle of its elements, for what the
/// very rim receives holds for little of an element.
/// Which vertices gather, and with which weight, depends on geometry alone.
class DetailGather {
public:
    /// Traces the rays. `patches` must outlive this.
    explicit DetailGather(const PatchSet& patches);

    /// Corrects the indirect light of the vertices in question.
    /// \param nodeIndirect the solver's, one a node of the patch set [lux]
    void apply(std::span<const glm::dvec3> nodeIndirect, Lighting& lighting) const;

    std::size_t vertexCount() const { return vertices_.size(); }
    std::uint64_t rayCount() const { return rayCount_; }

private:
    struct Gatherer {
        std::uint32_t vertex = 0;
        float detail = 0; ///< w
        float shut = 0;   ///< weight of G itself
    };
    void traceNodes(const class DrawnSurface& surface, const class HemisphereRays& rays);
    void traceVertices(const DrawnSurface& surface, const HemisphereRays& rays);
    /// What elements reflect [lm/m^2].
    struct Sent {
        std::vector<Rgb> all, direct; ///< of all light, and of direct light alone
    };
    glm::dvec3 gathered(const Sent& sent, const std::uint32_t* hits) const;

    const PatchSet& patches_;
    std::vector<Gatherer> vertices_;
    std::vector<std::uint32_t>
        vertexHits_; ///< element that each ray meets, Element::kNone: nothing
    std::vector<std::uint32_t> nodeHits_;
    std::vector<double> nodeOpenness_;
    std::uint64_t rayCount_ = 0;
};

} // namespace penumbra
