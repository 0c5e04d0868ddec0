// The light of a lit surface as it is on the screen.
#pragma once

#include "base/Rgb.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace penumbra {

constexpr std::size_t kMostPreviewed = 8;

/// Factors (see LightShare) of the previewed lights at a vertex; negative: not known.
struct LightFactors {
    LightFactors() : LightFactors(-1) {}
    explicit LightFactors(float all) { of.fill(all); }
    float& operator[](std::size_t light) { return of[light]; }
    float operator[](std::size_t light) const { return of[light]; }
    friend bool operator==(const LightFactors&, const LightFactors&) = default;

    std::array<float, kMostPreviewed> of;
};

/// A vertex that began with the light of another one, which it replaces in triangles.
struct AdoptedVertex {
    std::uint32_t vertex = 0, from = 0;
};

/// Instead of what a LitGeometry carries: the same vertices, in the same blocks.
struct ShownLight {
    std::vector<Rgb> direct, indirect; ///< [lux]
    /// Of the previewed lights, that direct contains. Empty: there are none.
    std::vector<LightFactors> factors;
    /// Share of the light that is of the scene state which most vertices have left behind, in
    /// [0, 1] (see PreviewLighting::Anchor). As long as factors.
    std::vector<float> behind;

    /// From the last time that triangles changed their vertices.
    std::vector<AdoptedVertex> adopted;

    /// Corners of triangles that are drawn with light of their own: the arrays above go on,
    /// behind the vertices of the geometry, with copies of these vertices,
    std::vector<std::uint32_t> copies;
    /// and these entries of LitMeshData::indices are drawn with those, counted from the first one
    /// of the geometry.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> redrawn;
    std::uint64_t redrawnRevision = 0; ///< rises when copies or redrawn change

    std::vector<std::uint64_t> blockRevisions; ///< one a block, rises when any of this changes
    /// From the revision `from` of a block to `to` nothing of it changed but its indirect light.
    struct IndirectRun {
        std::uint64_t from = 0, to = 0;
    };
    std::vector<IndirectRun> indirectRuns; ///< one a block; may be fewer
    /// Whether a copy as of a revision of a block differs from it in indirect light alone.
    bool onlyIndirectSince(std::size_t block, std::uint64_t copied) const {
        return block < indirectRuns.size() && indirectRuns[block].to == blockRevisions[block] &&
               indirectRuns[block].from <= copied;
    }
    std::uint64_t revision = 1; ///< rises when any of these does
};

} // namespace penumbra
