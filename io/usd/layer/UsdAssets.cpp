#include "io/usd/layer/UsdAssets.h"

#include "base/FileBytes.h"

#include <filesystem>

namespace penumbra {

namespace fs = std::filesystem;

std::string UsdAssets::resolve(const std::string& anchor, const std::string& asset) const {
    return (fs::path(anchor).parent_path() / asset).string();
}

std::string UsdAssets::canonical(const std::string& identifier) const {
    std::error_code ignored;
    return fs::weakly_canonical(identifier, ignored).string();
}

UsdLayer UsdAssets::layer(const std::string& identifier, const UsdLayerLimits& limits) const {
    return readUsdLayer(identifier, limits);
}

UsdAssetBytes UsdAssets::bytes(const std::string& identifier) const {
    const auto file = std::make_shared<const FileBytes>(identifier);
    return {file, file->bytes()};
}

} // namespace penumbra
