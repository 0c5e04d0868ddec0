// Into how many parts the edges of a mesh's faces are cut.
#pragma once

#include "radiosity/surface/LimitSurface.h"
#include "radiosity/surface/SurfaceMesh.h"

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

namespace penumbra {

/// How one edge is cut: into `patches` parts, each into elements, `elements` in all.
struct EdgeRate {
    int patches = 1;
    int elements = 1;
};

/// What each face wants of its edges, and what both faces of an edge get.
///
/// An edge is cut by its length, and so that the normal turns little within an element. A pattern
/// has about rate^2 pieces, which for a sliver is far more than its area holds. So each face keeps
/// its pieces below
///
///     6 max(1, corners / 4) area / size^2 + corners + some
///
/// with size that of a patch and some = 16, or that of an element and some = 64. Where there would
/// be more, all of its rates are coarsened by one factor, but for what a bend asks. An edge is cut
/// as the more demanding of its faces wants it, so that both cut it alike, and a large face beside
/// a sliver keeps its elements.
///
/// The 6 is what the grids at the corners of a slender triangle need. A triangle that is slimmer
/// still, of more pieces than with some = 8, and has one short edge, a needle, is a strip instead:
/// a quadrilateral whose first two corners are the one opposite that edge, in rows from there to
/// the edge. Its pieces are as long as wide or longer, and no more than those of a square of its
/// area: area / size^2 + 4 + some, with some = 4 for patches, 64 for elements.
class EdgeRates {
public:
    /// \param patchSize, elementSize longest edges of patches and elements [m], above 0
    EdgeRates(const SurfaceMesh& mesh, const LimitSurface& surface, float patchSize,
              float elementSize);

    /// What face `face` wants of its edges, one by one from its first corner on: what its inside
    /// is cut by. Empty if it has no surface.
    std::span<const EdgeRate> ofFace(std::uint32_t face) const;
    /// The corners between these edges: those of the face, or four of which the first two are the
    /// same, for a needle.
    std::span<const std::uint32_t> cornersOf(std::uint32_t face) const;
    /// Elements along the edge between two corners, at least what any of its faces wants.
    int along(std::uint32_t a, std::uint32_t b) const;
    /// Whether no edge of a face is cut.
    bool isWhole(std::uint32_t face) const;

private:
    /// What an edge asks for by itself. `bent`: elements that its bend asks for.
    struct Wanted {
        EdgeRate rate;
        int bent = 1;
    };
    /// What a face wants of its edges, one by one.
    struct FaceRates {
        std::vector<std::uint32_t> corners;
        std::vector<int> patches, elements, bent;
    };
    Wanted cut(float length, float bend) const;
    Wanted wantedOf(const FaceSurface& face, std::span<const std::uint32_t> corners,
                    std::size_t edge);
    FaceRates wantedBy(const FaceSurface& face, std::span<const std::uint32_t> corners);
    bool makeStrip(FaceRates& rates) const;
    bool addSmall(std::span<const std::uint32_t> corners);
    void addFace(const FaceSurface& face, std::span<const std::uint32_t> corners);

    const SurfaceMesh& mesh_;
    bool subdivided_;
    float patchSize_, elementSize_;
    /// Of each edge of a subdivision surface, whichever face asks first.
    std::unordered_map<std::uint64_t, Wanted> wanted_;
    std::unordered_map<std::uint64_t, int> elements_; ///< of each edge that is cut
    std::vector<std::uint8_t> atCut_;                 ///< 1: a point at the end of such an edge
    std::vector<EdgeRate> rates_;                     ///< of all faces, one after the other
    std::vector<std::uint32_t> corners_;              ///< where each of those edges begins
    std::vector<std::size_t> first_;                  ///< of a face in rates_; and their end
};

} // namespace penumbra
