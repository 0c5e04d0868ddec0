#include "viewer/input/StartSizes.h"

#include "scenegraph/Objects.h"

namespace penumbra {

MeshingOptions startSizes(const std::string& file, const LoadedScene& loaded,
                          std::optional<double> frame, MeshingOptions asked) {
    if (asked.patchSize == 0) asked.patchSize = float(loaded.scene->patchSize);
    if (asked.elementSize == 0) asked.elementSize = float(loaded.scene->elementSize);
    if (asked.patchSize > 0) return asked;
    const std::shared_ptr<Scene> atStart = frame ? loadUsdScene(file).scene : loaded.scene;
    asked.patchSize = resolvedSizes(placeScene(*atStart), asked).patchSize;
    return asked;
}

} // namespace penumbra
