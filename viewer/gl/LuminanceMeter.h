// What the picture's luminances are, read back without waiting for the graphics card.
#pragma once

#include "viewer/gl/GlObject.h"
#include "viewer/gl/ScreenPass.h"

#include <array>
#include <optional>
#include <vector>

namespace penumbra {

/// Meters a picture on MeterGrid and brings the values back a frame or two later, when they have
/// arrived.
class LuminanceMeter {
public:
    LuminanceMeter();
    ~LuminanceMeter();
    LuminanceMeter(const LuminanceMeter&) = delete;
    LuminanceMeter& operator=(const LuminanceMeter&) = delete;

    /// Begins a measurement unless all buffers are still under way.
    /// \param texture as HdrTarget::texture(): its alpha is what counts
    void measure(unsigned texture);

    /// The latest measurement that has arrived, once: what meteredLuminances() makes of it [nit].
    /// \param wait until there is one
    std::optional<std::vector<float>> take(bool wait = false);

private:
    struct Transfer {
        GlObject buffer;
        void* fence = nullptr; ///< of OpenGL; null: free
    };

    std::optional<std::vector<float>> finish(Transfer& transfer, bool wait);

    ScreenPass pass_;
    GlObject texture_, framebuffer_;
    std::array<Transfer, 3> transfers_;
    std::size_t next_ = 0; ///< where the next measurement goes; the oldest one under way
};

} // namespace penumbra
