// Where overlays are drawn before they are laid over the tone-mapped picture.
#pragma once

#include "viewer/gl/GlObject.h"

namespace penumbra {

class HdrTarget;

/// A framebuffer of display colours with premultiplied alpha, which shares the depth buffer of the
/// picture that it is going to lie over, and as many samples.
class OverlayTarget {
public:
    /// \param under must outlive this \throws Error if the driver can't make it
    explicit OverlayTarget(const HdrTarget& under);

    /// Binds the framebuffer with its viewport, and clears its colours; depth stays.
    void begin() const;
    /// Averages the samples into texture().
    void resolve() const;
    /// Name of the texture with the averages: good after resolve().
    unsigned texture() const { return colour_.name(); }

private:
    int width_, height_;
    GlObject drawn_, resolved_; ///< framebuffers; drawn_ only if there are several samples
    GlObject sampledColour_, colour_;
};

} // namespace penumbra
