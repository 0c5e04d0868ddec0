// Lit frames to files, from the solution as it is.
#pragma once

#include "io/image/ToneCurve.h"
#include "scenegraph/Camera.h"
#include "scenegraph/Group.h"
#include "viewer/gl/Renderer.h"

#include <glm/glm.hpp>

#include <string>

namespace penumbra {

/// Draws a view of `lit` and writes it as OpenEXR with all layers, whole or not at all. The
/// renderer's context must be current.
/// \param scene name of the scene's file, for the picture's attributes
/// \param size  [pixel] \throws Error
void saveLayers(const std::string& path, const std::string& scene, Renderer& renderer,
                const Group& lit, const View& view, glm::ivec2 size);

/// `name`-0001, -0002, ...: the first of which neither an .exr nor a .png is there yet.
std::string freeStem(const std::string& name);

/// For people: how a picture is shown, in parentheses.
std::string describeExposure(float middleGrey, ToneStyle style);

} // namespace penumbra
