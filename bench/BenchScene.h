// What the benchmarks of whole scenes share: a scene on the way to its patches, clocks, peak
// memory.
#pragma once

#include "io/usd/scene/UsdScene.h"
#include "radiosity/mesh/BuildPatches.h"
#include "scenegraph/Objects.h"

#include <string>

namespace penumbra {

/// Reads one of scenes/*.usda. \param name of the file, without its ending; or the path of any
/// scene
LoadedScene loadScene(const std::string& name);

/// \param elementSize longest edge of an element [m]; 0: the default. The patch size is always what
///                    the file asks for, or the default.
MeshingOptions meshingOf(const LightRequest& asked, float elementSize);

/// A scene, read but not yet meshed.
class BenchScene {
public:
    /// See loadScene().
    explicit BenchScene(const std::string& name);

    /// See meshingOf(). \param patchSize other than the file's [m]; 0: the file's
    BuiltPatches mesh(float elementSize, float patchSize = 0) const;

private:
    LoadedScene loaded_;
    PlacedScene placed_;
};

/// Wall and processor time since it was made, by the thread that asks.
class Stopwatch {
public:
    Stopwatch();
    double wall() const;   ///< [s]
    double cpu() const;    ///< of all threads of the process [s]
    double thread() const; ///< of this thread alone [s]

private:
    double wallStart_, cpuStart_, threadStart_;
};

} // namespace penumbra
