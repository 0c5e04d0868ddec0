// Where the walkthrough is drawn before it is tone mapped.
#pragma once

#include "base/Rgb.h"
#include "viewer/gl/GlObject.h"

#include <vector>

namespace penumbra {

/// A framebuffer of luminances [nit] with a depth buffer, multisampled if wanted, and a texture
/// that its averages go to. Alpha is the share of the pixel that counts for exposure: reflecting
/// surfaces do, lights and what lies outside do not.
class HdrTarget {
public:
    enum class Precision { half, single }; ///< half: up to 65504 nit, relative error 2^-11

    /// \param samples a pixel; halved until the driver can do it
    /// \throws Error if the driver can't make it at all
    HdrTarget(int width, int height, int samples, Precision precision);

    int width() const { return width_; }
    int height() const { return height_; }
    int samples() const { return samples_; }

    /// Binds the framebuffer with its viewport, and clears it.
    void begin(float clearDepth) const;
    /// Averages the samples into texture().
    void resolve() const;
    /// Name of the texture with the averages: good after resolve().
    unsigned texture() const { return colour_.name(); }
    /// Name of the multisampled texture with the samples themselves; 0 if there is one a pixel.
    unsigned samplesTexture() const { return sampledColour_.name(); }

    /// Name of the renderbuffer with the depths of the samples.
    unsigned depth() const { return depth_.name(); }

    /// The averages, lower row first.
    std::vector<Rgb> read() const;

private:
    bool makeSamples(unsigned format, int samples);

    int width_, height_, samples_;
    GlObject drawn_, resolved_; ///< framebuffers; one and the same surface without multisampling
    GlObject sampledColour_, depth_, colour_;
};

} // namespace penumbra
