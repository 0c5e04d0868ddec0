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

/// Corners of triangles that are drawn with light of their own, by copies of vertices. A value:
/// who draws them compares it with the one that was drawn.
struct SplitCorners {
    std::vector<std::uint32_t> copies; ///< the vertices that they are copies of
    /// Entries of LitMeshData::indices, and the copies that they are drawn with; of several for one
    /// entry the last holds.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> entries;

    bool empty() const { return copies.empty(); }
    friend bool operator==(const SplitCorners&, const SplitCorners&) = default;
};

/// Instead of what a LitGeometry carries: the same vertices, in the same blocks. There is one for a
/// geometry: LightFade goes on with it, RayPreview adds what moves and takes that back, and
/// GpuGeometry has what it is.
struct ShownLight {
    std::vector<Rgb> direct, indirect; ///< [lux]; of vertices, then of the copies in `corners`
    /// Of the previewed lights, that direct contains. Empty: there are none.
    std::vector<LightFactors> factors;
    /// Share of the light that is of the scene state which most vertices have left behind, in
    /// [0, 1] (see PreviewLighting::Anchor). As long as factors.
    std::vector<float> behind;

    /// From the last time that triangles changed their vertices.
    std::vector<AdoptedVertex> adopted;
    SplitCorners corners;

    std::vector<std::uint64_t> blockRevisions; ///< one a block, changes when any of this does
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

    std::size_t vertices() const { return direct.size() - corners.copies.size(); }
    /// To be called when something of a block has changed; no revision comes twice.
    void touch(std::size_t block) { blockRevisions[block] = ++revision; }
    /// Makes as many blocks as the light needs, and touches those in which copies lie.
    void touchCopies();
};

} // namespace penumbra
