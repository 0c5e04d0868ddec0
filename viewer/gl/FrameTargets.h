// Float framebuffers for a strip of a picture, and the way back from them.
#pragma once

#include "base/FrameLayers.h"
#include "viewer/gl/GlObject.h"
#include "viewer/gl/ScreenPass.h"

#include <optional>
#include <vector>

namespace penumbra {

/// Some rows of a picture [pixel]; the top row is row 0.
struct Strip {
    int top = 0;
    int height = 0;
};

/// What a strip of FrameLayers is drawn into: a multisampled framebuffer for light, which is
/// averaged over the pixel, and one of a single sample for what the surface under the pixel's
/// centre is. All channels are 32-bit floats (ids: integers), the depth buffers as well.
class FrameTargets {
public:
    /// \param width,height size of the largest strip
    /// \param samples      a pixel; halved until the driver can do it
    /// \throws Error if the driver can't make even the single-sampled ones
    FrameTargets(int width, int height, int samples);

    int width() const { return width_; }
    int height() const { return height_; }
    int samples() const { return samples_; } ///< 1: not multisampled

    /// Binds and clears the framebuffer for kLightFragmentShader's outputs.
    void beginLight(float clearDepth) const;
    /// Binds and clears the framebuffer for kSurfaceFragmentShader's outputs.
    void beginSurface(float clearDepth) const;

    /// Copies both into `frame`, of which `strip` was drawn at the targets' lower edge. The mean of
    /// the samples is that of linear luminances, since that is what the pixel measures; only the
    /// layer `shown`, if `tone` is given, is the mean of what is shown of them.
    void readInto(FrameLayers& frame, const Strip& strip, const ToneMap& tone);

private:
    /// A framebuffer and the renderbuffers behind it.
    struct Target {
        GlObject framebuffer;
        std::vector<GlObject> buffers;  ///< renderbuffers
        std::vector<GlObject> textures; ///< multisampled: their samples can be read one by one
    };

    /// \param colourFormats OpenGL's internal formats, in the order of the shader's outputs; with
    ///        more than one sample the first one is that of a texture
    Target makeTarget(const std::vector<unsigned>& colourFormats, bool depth, int samples) const;
    void readLight(FrameLayers& frame, const Strip& strip) const;
    void readSurface(FrameLayers& frame, const Strip& strip) const;
    void readShown(FrameLayers& frame, const Strip& strip, const ToneMap& tone);
    void makeLight();

    int width_, height_, samples_;
    Target light_;    ///< beauty with alpha, direct, indirect
    Target surface_;  ///< normal and depth, albedo, illuminance, object id
    Target resolved_; ///< one of the light layers: averaged, or one of its samples
    std::optional<ScreenPass> oneSample_;
};

} // namespace penumbra
