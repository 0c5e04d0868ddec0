// The walkthrough's pictures: drawn in luminances, shown through exposure and tone curve.
#pragma once

#include "io/image/ToneCurve.h"
#include "scenegraph/Camera.h"
#include "viewer/gl/DrawStatistics.h"
#include "viewer/gl/HdrTarget.h"
#include "viewer/gl/UnlitLighting.h"
#include "viewer/overlay/Overlay.h"
#include "viewer/preview/DrawList.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace penumbra {

struct InteractiveOptions {
    int samples = 4;        ///< a pixel
    bool compressed = true; ///< textures, where OpenGL can: not worth it where the processor draws
    /// Textures are sharp after some pictures only, so that none takes long.
    bool gradual = false;
    HdrTarget::Precision precision = HdrTarget::Precision::half;
};

class MapPreview;

/// A picture as the screen shows it.
struct DisplayedPicture {
    int width = 0, height = 0;       ///< [pixel]
    std::vector<std::uint8_t> bytes; ///< 8-bit sRGB, three a pixel, top row first
};

/// Draws a scene graph many times a second. A frame is
///
///     drawScene()   the graph into a float framebuffer, luminances [nit] against depth:
///                   lit surfaces as Renderer draws them, what is not lit yet by UnlitLighting
///     show()        that, through exposure and tone curve, into a framebuffer or window
///
/// between which others may draw into the same target, with the same depth convention.
///
/// Belongs to one context (OpenGL 3.3 core) that must be current in every call and at destruction.
class InteractiveRenderer {
public:
    explicit InteractiveRenderer(const InteractiveOptions& options = {});
    ~InteractiveRenderer();
    InteractiveRenderer(const InteractiveRenderer&) = delete;
    InteractiveRenderer& operator=(const InteractiveRenderer&) = delete;

    /// \param list         what is in view, see listVisible()
    /// \param width,height [pixel], at least 1 \throws Error if the driver can't
    /// \param maps         previewed lights that the shader brings up to date; null: none
    void drawScene(const DrawList& list, const View& view, const UnlitLighting& unlit, int width,
                   int height, MapPreview* maps = nullptr);

    /// Makes textures that were drawn sharper, as drawScene() does too, for some milliseconds.
    /// \return whether there is more to be done
    bool sharpenTextures();
    /// Makes all textures that were drawn as sharp as they get.
    void finishTextures();

    /// What show() lays over the lit surfaces of the pictures that drawScene() draws from now on.
    void setOverlay(OverlayPicture overlay);

    /// Shows what was drawn last, and what lies over it, in `framebuffer` (0: the window), whose
    /// lower left corner it fills.
    void show(unsigned framebuffer, float middleGrey, ToneStyle style);

    /// The very bytes that show() shows.
    DisplayedPicture displayed(float middleGrey, ToneStyle style);

    /// Reflected luminances [nit] of a frame drawn not long ago, once; see LuminanceMeter.
    /// \param wait for those of the last frame
    std::optional<std::vector<float>> luminances(bool wait = false);

    /// What was drawn last [nit], lower row first.
    std::vector<Rgb> readLuminances() const;

    const InteractiveStatistics& statistics() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace penumbra
