// Luminances to what the display shows, on the graphics card.
#pragma once

#include "io/image/ToneCurve.h"
#include "viewer/gl/GlObject.h"
#include "viewer/gl/ScreenPass.h"

#include <optional>

namespace penumbra {

/// Draws a texture of luminances [nit] as 8-bit sRGB, with exposure and tone curve, dithered like
/// displayBytes(): an 8-bit step is several visible thresholds.
class TonePass {
public:
    TonePass();

    struct Picture {
        unsigned luminances = 0; ///< texture [nit], linear Rec. 709
        /// The multisampled texture that these are the means of, or 0. Each sample goes through the
        /// tone curve and then they are averaged, so that the edges of lights are smooth.
        unsigned samples = 0;
        int sampleCount = 1;
        /// Texture of what lies over it: display colours with premultiplied alpha; 0: nothing.
        unsigned overlay = 0;
    };
    /// \param middleGrey luminance that is shown as 18 % grey [nit]
    /// Draws into the framebuffer that is bound, over its viewport, which begins at (0, 0) and has
    /// the size of the picture.
    void draw(const Picture& picture, float middleGrey, ToneStyle style);

private:
    void load(ToneStyle style);
    const ScreenPass& passFor(const Picture& picture);

    ScreenPass pass_;
    std::optional<ScreenPass> samplesPass_; ///< when it is needed first
    GlObject table_;                        ///< the curve, one row
    GlObject nothing_;                      ///< an overlay of one transparent texel
    std::optional<ToneStyle> loaded_;
    ToneCurve curve_{ToneStyle::srgb};
};

} // namespace penumbra
