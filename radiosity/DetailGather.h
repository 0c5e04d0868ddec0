// Indirect light where it varies faster than patches can tell: in gaps, under things, along edges.
#pragma once

#include "radiosity/PatchSet.h"
#include "radiosity/Solver.h"

#include <cstdint>
#include <vector>

namespace penumbra {

struct DetailOptions {
    int rays = 64;          ///< over the hemisphere of a vertex that needs them
    float tolerance = 0.1f; ///< by how much its openness may differ from what its patch suggests
    float shut = 0.45f;     ///< openness below which near surfaces matter more than patches can tell
};

/// Indirect light is exchanged between patches and interpolated to the vertices. That misses shadows
/// of indirect light that are smaller than a patch. They are found by openness, the cosine-weighted
/// share of the hemisphere that is free of surfaces nearer than a patch's size: a vertex whose openness
/// is small, or differs from the value interpolated from its patch's nodes, gathers its indirect light
/// itself, by rays to the surfaces around it. Which vertices do depends on geometry alone.
class DetailGather {
public:
    /// Traces the rays. `patches` must outlive this.
    explicit DetailGather(const PatchSet& patches, const DetailOptions& options = {});

    /// Replaces the indirect light of the vertices in question, given that of all others.
    void apply(Lighting& lighting) const;

    std::size_t vertexCount() const { return vertices_.size(); }
    std::uint64_t rayCount() const { return rayCount_; }

private:
    const PatchSet& patches_;
    int rays_;
    std::vector<std::uint32_t> vertices_; ///< that gather
    std::vector<float> openness_;         ///< of theirs
    std::vector<std::uint32_t> hits_;     ///< element that each ray meets, Element::kNone: nothing lit
    std::uint64_t rayCount_ = 0;
};

} // namespace penumbra
