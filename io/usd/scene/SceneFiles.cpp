#include "io/usd/scene/SceneFiles.h"

#include "io/model/ModelImport.h"

namespace penumbra {

UsdLayer SceneFiles::layer(const std::string& identifier, const UsdLayerLimits& limits) const {
    if (!modelFormatOf(identifier)) return UsdFiles::layer(identifier, limits);
    ImportedModel model = importModel(identifier, {.maxFileBytes = limits.fileBytes});
    const std::lock_guard lock(partsMutex_);
    parts_.insert(parts_.end(), model.files.begin() + 1, model.files.end()); // without itself
    for (ImportedImage& image : model.images)
        pictures_[canonical(identifier + "[" + image.name + "]")] =
            std::make_shared<const std::vector<std::byte>>(std::move(image.bytes));
    return std::move(model.layer);
}

UsdAssetBytes SceneFiles::bytes(const std::string& identifier) const {
    {
        const std::lock_guard lock(partsMutex_);
        const auto found = pictures_.find(canonical(identifier));
        if (found != pictures_.end()) return {found->second, *found->second};
    }
    return UsdFiles::bytes(identifier);
}

std::vector<std::filesystem::path> SceneFiles::parts() const {
    const std::lock_guard lock(partsMutex_);
    return parts_;
}

} // namespace penumbra
