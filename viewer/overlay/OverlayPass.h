// Draws overlays over surfaces.
#pragma once

#include "scenegraph/LitGeometry.h"
#include "viewer/gl/GlObject.h"
#include "viewer/gl/LitItem.h"
#include "viewer/gl/ShaderProgram.h"
#include "viewer/overlay/Overlay.h"

#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

namespace penumbra {

/// Draws an overlay over surfaces whose depths are in the framebuffer: display colours with
/// premultiplied alpha, see OverlayTarget.
class OverlayPass {
public:
    /// Of lines, see kindColour().
    static constexpr std::size_t kPatchKind = 3, kElementKind = 1;

    OverlayPass();

    void draw(const OverlayPicture& picture, const std::vector<LitItem>& items, bool reversedDepth);
    /// Drops what belongs to geometries that are gone.
    void dropDead();

private:
    /// Vertices don't move within a geometry: lines stay, but for new triangles.
    struct Lines {
        std::weak_ptr<const Node> alive;
        std::size_t triangles = 0;
        GlObject vertexArray, positions, indices;
        std::size_t patches = 0, elements = 0; ///< indices, first those of patches
    };

    const Lines& linesOf(const LitItem& item);
    void drawLines(const std::vector<LitItem>& items);
    void drawBlocks(const BlockColours& colours, const std::vector<LitItem>& items);

    ShaderProgram lineProgram_, blockProgram_;
    GlObject blockBuffer_, blockTexture_;
    std::unordered_map<const LitGeometry*, Lines> lines_;
};

} // namespace penumbra
