// A window with an OpenGL context, by GLFW.
#pragma once

#include "viewer/input/Input.h"

#include <glm/glm.hpp>

#include <memory>
#include <string>
#include <vector>

struct GLFWwindow;

namespace penumbra {

struct WindowOptions {
    int width = 1136, height = 639; ///< [screen coordinates]
    std::string title = "Penumbra";
    bool vsync = true;
};

/// One window, one OpenGL 3.3 core context, current in the thread that made it. At most one in a
/// program at a time, which must be used from the main thread (GLFW's own rules).
class Window {
public:
    /// \throws Error one line that says what is missing and what to do instead: no display, no
    ///         OpenGL 3.3
    explicit Window(const WindowOptions& options);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    /// Takes in what the window system has to say; waits up to `seconds` for something.
    void poll(double seconds = 0);
    /// What came in since the last call, in order.
    std::vector<InputEvent> takeEvents();

    /// Shows what was drawn. \throws Error if the graphics card was reset and the context is gone
    void show();
    /// Waits until it has been drawn.
    void finish();

    /// Whether somebody has asked, since the last call, that the window be closed.
    bool takeClosing();
    void setTitle(const std::string& title);
    /// Hides the pointer and lets it move without end, for looking around.
    void capturePointer(bool captured);
    bool pointerCaptured() const;
    void setFullScreen(bool full);
    bool fullScreen() const;

    glm::ivec2 pixels() const;    ///< size of the framebuffer; 0 while minimised
    glm::ivec2 size() const;      ///< in screen coordinates, what WindowOptions takes
    float contentScale() const;   ///< 1 at 96 dpi
    bool visible() const;         ///< neither minimised nor of no size
    std::string renderer() const; ///< OpenGL's, for people
    /// Pictures by the processor: what costs little on a graphics card counts there.
    bool drawnInSoftware() const;
    GLFWwindow* handle() const; ///< for ImGui

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace penumbra
