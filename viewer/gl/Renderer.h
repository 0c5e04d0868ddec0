// Draws lit scene graphs with OpenGL.
#pragma once

#include "base/FrameLayers.h"
#include "scenegraph/Camera.h"
#include "scenegraph/Group.h"

#include <cstddef>
#include <memory>

namespace penumbra {

class OffscreenContext;

struct RendererOptions {
    int samples = 4; ///< a pixel, for the averaged layers; fewer if the driver can't
    /// What is drawn at once, in strips of whole rows [pixel]: bounds the memory, some 0.4 kB a
    /// pixel.
    int stripPixels = 1 << 21;
};

/// What the last frame cost.
struct RenderStatistics {
    std::size_t drawn = 0;        ///< instances of a LitGeometry in view
    std::size_t culled = 0;       ///< instances outside of it
    std::size_t drawCalls = 0;    ///< over both passes and all strips
    std::size_t uploads = 0;      ///< geometries copied to the graphics card
    std::size_t lightUploads = 0; ///< of which the light alone was copied
    int samples = 0;              ///< a pixel
};

/// Draws every LitGeometry below a group. Triangles are one-sided: what is clockwise on the screen
/// is not drawn (in mirrored frames the sides keep their meaning). The luminance [nit] of a point
/// is
///
///     L = rho / pi * (direct + indirect) + emission
///
/// with illuminances [lux] interpolated linearly over each triangle, perspective-correctly.
///
/// Depth is kept as reversed 32-bit floats where glClipControl exists (OpenGL 4.5; Lapidous & Jiao,
/// Graphics Hardware 1999), which stays sharp over clipping ranges such as 1 mm to 1000 km;
/// elsewhere as plain ones.
///
/// One renderer belongs to one context, which must be current in every call and at destruction; it
/// needs OpenGL 3.3 core and no window.
class Renderer {
public:
    explicit Renderer(const RendererOptions& options = {});
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    /// The picture that `view` has of `root`, all layers; `shown` if there is a `tone`.
    /// \param width,height [pixel], at least 1
    /// \throws Error if the driver can't make a picture of this size
    FrameLayers render(const Group& root, const View& view, int width, int height,
                       const ToneMap& tone = {});

    const RenderStatistics& statistics() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Renderer::render() with `context` made current first.
FrameLayers renderFrame(OffscreenContext& context, Renderer& renderer, const Group& root,
                        const View& view, int width, int height, const ToneMap& tone = {});

} // namespace penumbra
