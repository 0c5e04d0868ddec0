// The reference picture: primary rays, direct light evaluated in every pixel.
#pragma once

#include "base/FrameLayers.h"
#include "radiosity/mesh/PatchSet.h"
#include "radiosity/rays/RayScene.h"
#include "radiosity/transport/Solver.h"
#include "scenegraph/Camera.h"

#include <functional>

namespace penumbra {

struct FinalOptions {
    int raysPerSide = 2; ///< primary rays a pixel = raysPerSide squared, stratified
    ToneMap tone{};      ///< if there is one, the layer `shown` is filled by it
    std::function<void(double done)> progress{};
};

/// Traces a view of the solved scene: in every pixel direct light by closed form times stratified
/// shadow rays, indirect light interpolated from the solution. Layers as Renderer::render() fills
/// them. The same picture for any number of threads.
FrameLayers traceFrame(const PatchSet& patches, const RayScene& rays, const Lighting& lighting,
                       const View& view, int width, int height, const FinalOptions& options = {});

} // namespace penumbra
