// The walkthrough as a program: a window onto a scene.
#pragma once

#include <string>

namespace penumbra {

struct ViewerOptions {
    std::string scene; ///< USD text
    bool vsync = true;
    int samples = 0; ///< a pixel; 0: 4 with a graphics card, 1 without
};

/// Opens a window onto a scene, and returns when it was closed, or when the program was asked to
/// end (SIGINT, SIGTERM, SIGHUP). \throws Error without a display, OpenGL 3.3 or a scene
void runViewer(const ViewerOptions& options);

} // namespace penumbra
