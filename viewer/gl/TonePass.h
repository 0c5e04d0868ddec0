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

    /// \param texture    of linear Rec. 709 luminances
    /// \param middleGrey luminance that is shown as 18 % grey [nit]
    /// \param overlay    texture of what lies over the picture: display colours with premultiplied
    ///                   alpha; 0: nothing
    /// Draws into the framebuffer that is bound, over its viewport.
    void draw(unsigned texture, float middleGrey, ToneStyle style, unsigned overlay = 0);

private:
    void load(ToneStyle style);

    ScreenPass pass_;
    GlObject table_;   ///< the curve, one row
    GlObject nothing_; ///< an overlay of one transparent texel
    std::optional<ToneStyle> loaded_;
    ToneCurve curve_{ToneStyle::srgb};
};

} // namespace penumbra
