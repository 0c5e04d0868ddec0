#include "radiosity/process/RadiosityOptions.h"

namespace penumbra {

RadiosityOptions optionsOf(const Scene& scene) {
    RadiosityOptions options;
    options.meshing.patchSize = float(scene.patchSize);
    options.meshing.elementSize = float(scene.elementSize);
    options.solving.residual = scene.residual;
    if (scene.trigger == "onDemand") options.trigger = Trigger::onDemand;
    if (scene.trigger == "continuous") options.trigger = Trigger::continuous;
    if (scene.policy == "plain") options.solving.policy = PolicyKind::plain;
    return options;
}

} // namespace penumbra
