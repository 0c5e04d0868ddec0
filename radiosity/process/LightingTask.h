// What a worker is to light, and how.
#pragma once

#include "radiosity/process/RadiosityOptions.h"
#include "radiosity/process/snapshot/SceneSnapshot.h"

#include <optional>

namespace penumbra {

struct LightingTask {
    MeshingOptions meshing;
    SolverOptions solving;
    SceneSnapshot scene;
};

/// \param scene instead of the task's own
void write(ByteWriter& out, const LightingTask& task, const SceneSnapshot& scene);
/// \return none: it is not one, or asks for what can't be
std::optional<LightingTask> readLightingTask(ByteReader& in);

} // namespace penumbra
