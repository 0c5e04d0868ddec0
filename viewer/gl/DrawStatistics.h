// What a frame of the walkthrough took to draw.
#pragma once

#include <cstddef>

namespace penumbra {

/// What the last InteractiveRenderer::drawScene() did.
struct InteractiveStatistics {
    std::size_t lit = 0;          ///< instances of lit surfaces in view
    std::size_t unlit = 0;        ///< instances of meshes and lights that are not lit yet
    std::size_t culled = 0;       ///< instances outside of the view
    std::size_t uploads = 0;      ///< lit geometries copied to the graphics card
    std::size_t lightUploads = 0; ///< of which the light alone was copied
    std::size_t lightBytes = 0;   ///< of that light: changed blocks only
    std::size_t shadowMaps = 0;   ///< drawn for previewed lights
    bool blurred = false;         ///< textures will be sharper in the next picture
};

} // namespace penumbra
