// The radiosity process.
#pragma once

#include "radiosity/process/LightingLink.h"

#include <string>

namespace penumbra {

/// Lights what a viewer has to be lit, until it says stop or ends. \param name of the shared memory
/// \throws Error if no viewer waits there, or if what it says makes no sense
void runLightingProcess(const std::string& name, const WorkerLimits& limits);

} // namespace penumbra
