// Draws lit surfaces whose light changes while something moves.
#pragma once

#include "viewer/gl/GeometryCache.h"
#include "viewer/gl/LitItem.h"
#include "viewer/gl/ShaderProgram.h"
#include "viewer/preview/PreviewLighting.h"
#include "viewer/shadowmaps/IndexRuns.h"

#include <cstddef>
#include <memory>
#include <vector>

namespace penumbra {

/// What the last prepare() did.
struct PreviewStatistics {
    std::size_t maps = 0; ///< shadow maps drawn
};

/// The renderer's part of PreviewLighting: shadow maps of what moves, tight around it, and of what
/// is in the same light, for each scene state; and a program that adds the change of the light
/// to what vertices carry. It is used for those triangles alone that a change may reach: whose
/// shaft to a light meets what moves; all others are drawn as ever.
class MapPreview {
public:
    MapPreview();
    ~MapPreview();

    /// Draws the shadow maps that are not there yet. Leaves no framebuffer bound.
    /// \param light with PreviewLighting::active()
    void prepare(const PreviewLighting& light, GeometryCache& cache);

    /// Which lights' change may reach a triangle of a chunk, a bit a light. After prepare(), before
    /// the next.
    unsigned reaching(const LitItem& item, const TriangleChunk& chunk) const;

    /// Triangles of one range of an item that the same lights reach.
    struct Runs {
        std::size_t item = 0, range = 0;
        unsigned lights = 0;
        IndexRuns runs;
    };
    /// \param runs by item
    void draw(const std::vector<LitItem>& items, const std::vector<Runs>& runs);

    const PreviewStatistics& statistics() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace penumbra
