// What a worker is to light, and how.
#pragma once

#include "radiosity/process/GraphImage.h"
#include "radiosity/process/RadiosityOptions.h"

#include <optional>

namespace penumbra {

struct LightingTask {
    MeshingOptions meshing;
    SolverOptions solving;
    GraphImage scene;
};

/// \param scene in place of the task's own
void write(ByteWriter& out, const LightingTask& task, const GraphImage& scene);
/// \return none: it is not one, or asks for what can't be
std::optional<LightingTask> readLightingTask(ByteReader& in);

} // namespace penumbra
