// Lit frames to files, from the solution as it is.
#pragma once

#include "io/image/ToneCurve.h"
#include "scenegraph/Camera.h"
#include "scenegraph/Group.h"
#include "viewer/gl/Renderer.h"

#include <string>

namespace penumbra {

/// A picture to be saved: OpenEXR with all layers, and a PNG as the screen shows it.
struct Picture {
    std::string stem; ///< the files are stem.exr and stem.png
    std::string scene;
    int width = 1280, height = 720; ///< [pixel]
    float middleGrey = 1;           ///< [nit]
    ToneStyle tone = ToneStyle::agx;
};

/// Draws and writes it, each file whole or not at all. The renderer's context must be current.
/// \throws Error
void savePicture(const Picture& picture, Renderer& renderer, const Group& lit, const View& view);

/// `name`-0001, -0002, ...: the first of which neither an .exr nor a .png is there yet.
std::string freeStem(const std::string& name);

} // namespace penumbra
