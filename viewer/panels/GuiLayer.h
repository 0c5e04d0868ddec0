// Dear ImGui over the window.
#pragma once

#include "viewer/input/Window.h"

#include <memory>

namespace penumbra {

/// The panels' drawing and input, on top of a window. Follows the window's pixel density. One at a
/// time, as ImGui has it; the window must outlive it and have been listening before.
class GuiLayer {
public:
    explicit GuiLayer(Window& window);
    ~GuiLayer();
    GuiLayer(const GuiLayer&) = delete;
    GuiLayer& operator=(const GuiLayer&) = delete;

    /// Between these two ImGui's functions may be called.
    void begin();
    void end();

    /// Whether a panel has the pointer or the keyboard: then it is not for the scene.
    bool wantsPointer() const;
    bool wantsKeyboard() const;
    /// Whether a panel is being used, so that pictures are wanted without any change of the scene.
    bool busy() const;

private:
    void scaleTo(float contentScale);

    Window& window_;
    float scale_ = 0;
};

} // namespace penumbra
