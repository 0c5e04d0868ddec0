// Draws lit surfaces whose light changes while something moves.
#pragma once

#include "viewer/GeometryCache.h"
#include "viewer/IndexRuns.h"
#include "viewer/LitItem.h"
#include "viewer/LiveLight.h"
#include "viewer/ShaderProgram.h"

#include <cstddef>
#include <memory>
#include <vector>

namespace penumbra {

/// What the last prepare() did.
struct LiveStatistics {
    std::size_t maps = 0; ///< shadow maps drawn
};

/// The renderer's part of LiveLight: shadow maps of what moves, tight around it, and of what
/// stands in the same light, for each arrangement; and a program that adds the change of the light
/// to what vertices carry. It is used for those triangles alone that a change may reach: whose
/// shaft to a lamp meets what moves; all others are drawn as ever.
class LivePass {
public:
    LivePass();
    ~LivePass();

    /// Draws the shadow maps that are not there yet. Leaves no framebuffer bound.
    /// \param light with LiveLight::active()
    void prepare(const LiveLight& light, GeometryCache& cache);

    /// Which lamps' change may reach a triangle of a chunk, a bit a lamp. After prepare(), before
    /// the next.
    unsigned reaching(const LitItem& item, const TriangleChunk& chunk) const;

    /// Triangles of one range of an item that the same lamps reach.
    struct Runs {
        std::size_t item = 0, range = 0;
        unsigned lamps = 0;
        IndexRuns runs;
    };
    /// \param runs by item
    void draw(const std::vector<LitItem>& items, const std::vector<Runs>& runs);

    const LiveStatistics& statistics() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace penumbra
