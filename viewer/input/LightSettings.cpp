#include "viewer/input/LightSettings.h"

#include "radiosity/mesh/BuildPatches.h"
#include "scenegraph/Objects.h"

namespace penumbra {

LightRequest lightSettings(const std::string& file, const LoadedScene& loaded,
                           std::optional<double> frame, const LightRequest& asked) {
    LightRequest settings = asked.orElse(loaded.asked);
    if (settings.patchSize) return settings;
    LoadOptions options = loaded.options;
    options.time.reset();
    const std::shared_ptr<Scene> atStart = frame ? loadUsdScene(file, options).scene : loaded.scene;
    MeshingOptions sizes;
    sizes.elementSize = float(settings.elementSize.value_or(0));
    settings.patchSize = resolvedSizes(placeScene(*atStart), sizes).patchSize;
    return settings;
}

} // namespace penumbra
