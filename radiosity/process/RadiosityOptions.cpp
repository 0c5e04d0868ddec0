#include "radiosity/process/RadiosityOptions.h"

namespace penumbra {

RadiosityOptions optionsFor(const LightRequest& request, RadiosityOptions options) {
    MeshingOptions& meshing = options.meshing;
    if (request.patchSize) meshing.patchSize = float(*request.patchSize);
    if (request.elementSize) meshing.elementSize = float(*request.elementSize);
    SolverOptions& solving = options.solving;
    solving.residual = request.residual.value_or(solving.residual);
    solving.policy = request.policy.value_or(solving.policy);
    options.trigger = request.trigger.value_or(options.trigger);
    return options;
}

} // namespace penumbra
