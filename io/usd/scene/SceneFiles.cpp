#include "io/usd/scene/SceneFiles.h"

#include "io/model/ModelImport.h"

namespace penumbra {

UsdLayer SceneFiles::layer(const std::string& identifier, const UsdLayerLimits& limits) const {
    if (!modelFormatOf(identifier)) return UsdFiles::layer(identifier, limits);
    ImportedModel model = importModel(identifier, {.maxFileBytes = limits.fileBytes});
    const std::lock_guard lock(partsMutex_);
    parts_.insert(parts_.end(), model.files.begin() + 1, model.files.end()); // without itself
    return std::move(model.layer);
}

std::vector<std::filesystem::path> SceneFiles::parts() const {
    const std::lock_guard lock(partsMutex_);
    return parts_;
}

} // namespace penumbra
