// OpenGL without a window.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

namespace penumbra {

/// An OpenGL 3.3 core context (or a later one that contains it) with no window, no surface and no
/// display server: pictures are drawn into framebuffer objects. Tried in this order, and the first
/// that gives a context is taken: EGL without surfaces (EGL_MESA_platform_surfaceless; Mesa, also
/// in software), EGL's graphics devices (EGL_EXT_platform_device; NVIDIA without a display), EGL's
/// default display.
class OffscreenContext {
public:
    /// Creates the context and makes it current in this thread.
    /// \param pixels of the picture that will be drawn: whether there is memory is asked first
    /// \throws Error one line that says what is missing and what to install
    explicit OffscreenContext(std::size_t pixels = 0);
    ~OffscreenContext();
    OffscreenContext(const OffscreenContext&) = delete;
    OffscreenContext& operator=(const OffscreenContext&) = delete;

    /// Makes the context current in the calling thread.
    /// \throws Error if it is current in another one
    void makeCurrent();

    /// The renderer's own name and version, for people, e.g. "llvmpipe (LLVM 15.0.6), OpenGL 4.5".
    std::string description() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace penumbra
