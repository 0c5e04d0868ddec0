// Depth maps from points of lights.
#pragma once

#include "viewer/gl/GlObject.h"
#include "viewer/gl/ShaderProgram.h"
#include "viewer/shadowmaps/IndexRuns.h"

#include <glm/glm.hpp>

#include <vector>

namespace penumbra {

class GpuGeometry;

/// What casts shadows, and its pose.
struct ShadowCaster {
    const GpuGeometry* gpu = nullptr;
    glm::mat4 place{1.0f}; ///< of its frame, in that of the maps
    IndexRuns runs;
};

/// Square layers of depths, each cut into tiles: a tile a point.
class ShadowMaps {
public:
    ShadowMaps();

    /// Makes room for so many layers of size x size texels; what was drawn is lost if that differs.
    /// \return whether it was \throws Error if the driver can't
    bool require(int layers, int size);

    /// Begins a layer of `tiles` x `tiles` tiles: all of it empty, at depth 1.
    void begin(int layer, int tiles);
    /// Draws into a tile of it. \param toClip from the frame of the maps
    void drawTile(int tile, const glm::mat4& toClip, const std::vector<ShadowCaster>& casters);
    void end();

    unsigned texture() const { return texture_.name(); }
    /// Side of a tile [texels].
    int tileSize(int tiles) const { return size_ / tiles; }

private:
    ShaderProgram program_;
    GlObject framebuffer_, texture_;
    int layers_ = 0, size_ = 0, tiles_ = 1;
};

} // namespace penumbra
