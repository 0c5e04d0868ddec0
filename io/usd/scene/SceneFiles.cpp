#include "io/usd/scene/SceneFiles.h"

#include "io/model/ModelImport.h"

namespace penumbra {

SceneFiles::SceneFiles(const std::filesystem::path& root, bool allowOutside,
                       std::uintmax_t maxFileBytes)
    : UsdFiles(maxFileBytes, allowOutside ? SceneFolders() : SceneFolders(root)),
      rootLayers_{canonical(root.string())} {}

UsdLayer SceneFiles::layer(const std::string& identifier, const UsdLayerLimits& limits) const {
    UsdLayer layer = readLayer(identifier, limits);
    const std::lock_guard lock(partsMutex_);
    if (!rootLayers_.contains(canonical(identifier))) return layer;
    for (const UsdSubLayer& sub : layer.subLayers) {
        const std::string file = resolve(layer.file, sub.asset);
        if (rootLayers_.insert(canonical(file)).second) allowFolderOf(file);
    }
    return layer;
}

UsdLayer SceneFiles::readLayer(const std::string& identifier, const UsdLayerLimits& limits) const {
    if (!modelFormatOf(identifier)) return UsdFiles::layer(identifier, limits);
    const SceneFolders allowed = folders();
    if (!allowed.hold(identifier)) return UsdFiles::layer(identifier, limits); // which refuses it
    ImportedModel model =
        importModel(identifier, {.maxFileBytes = limits.fileBytes, .folders = allowed});
    const std::lock_guard lock(partsMutex_);
    models_.insert(canonical(identifier));
    parts_.insert(parts_.end(), model.files.begin() + 1, model.files.end()); // without itself
    for (ImportedImage& image : model.images)
        pictures_[canonical(identifier + "[" + image.name + "]")] =
            std::make_shared<const std::vector<std::byte>>(std::move(image.bytes));
    return std::move(model.layer);
}

UsdAssetBytes SceneFiles::bytes(const std::string& identifier) const {
    const std::string model = identifier.substr(0, identifier.find_last_of('['));
    if (!identifier.ends_with(']') || !modelFormatOf(model)) return UsdFiles::bytes(identifier);
    const auto isRead = [&] {
        const std::lock_guard lock(partsMutex_);
        return models_.contains(canonical(model));
    };
    if (!isRead()) readLayer(model, {});
    const std::lock_guard lock(partsMutex_);
    const auto found = pictures_.find(canonical(identifier));
    if (found == pictures_.end())
        throw SceneFileError({identifier}, "there is no such picture in the model");
    return {found->second, *found->second};
}

std::vector<std::filesystem::path>
SceneFiles::withParts(std::vector<std::filesystem::path> layers) const {
    const std::lock_guard lock(partsMutex_);
    layers.insert(layers.end(), parts_.begin(), parts_.end());
    return layers;
}

} // namespace penumbra
