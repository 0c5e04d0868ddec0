// The walkthrough as a program: a window onto a scene.
#pragma once

#include "io/image/ToneCurve.h"
#include "io/usd/layer/UsdDiagnostic.h"
#include "radiosity/process/RadiosityOptions.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace penumbra {

struct ViewerOptions {
    std::string scene;              ///< USD text
    bool allowOutside = false;      ///< what a scene names is opened wherever it lies
    std::optional<double> frame;    ///< time code to begin with; none: the file's start
    RadiosityOptions light;         ///< but for what is in `asked`
    LightRequest asked;             ///< of the light; what is empty: what the file asks for
    std::string camera;             ///< path of the camera to begin with; empty: the first one
    std::string record;             ///< layer to record the session in; empty: none
    bool replay = false;            ///< play the file's animation from the start
    std::optional<double> exposure; ///< exposure value at ISO 100; none: metered in the view
    std::optional<ToneStyle> tone;  ///< none: that of the user's settings
    bool vsync = true;
    /// What lights the scene, started as `PROGRAM radiosity NAME`; empty: see ProcessLinkOptions.
    std::filesystem::path worker;
    int samples = 0; ///< a pixel; 0: 4 with a graphics card, 1 without
    /// Called once with what the reader has to say about the file.
    std::function<void(const std::vector<Diagnostic>&)> reported;
    /// Called once with the files that the scene was read from, before anything is written. May
    /// throw.
    std::function<void(const std::vector<std::filesystem::path>&)> opened;
};

/// Opens a window onto a scene, and returns when it was closed, or when the program was asked to
/// end (SIGINT, SIGTERM, SIGHUP). \throws Error without a display, OpenGL 3.3 or a scene
void runViewer(const ViewerOptions& options);

} // namespace penumbra
