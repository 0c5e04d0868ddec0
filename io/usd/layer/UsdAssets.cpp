#include "io/usd/layer/UsdAssets.h"

#include "base/FileBytes.h"

namespace penumbra {

namespace fs = std::filesystem;

std::string UsdAssets::resolve(const std::string& anchor, const std::string& asset) const {
    return (fs::path(anchor).parent_path() / asset).string();
}

std::string UsdAssets::canonical(const std::string& identifier) const {
    return canonicalPath(identifier).string();
}

UsdLayer UsdAssets::layer(const std::string& identifier, const UsdLayerLimits& limits) const {
    return readUsdLayer(identifier, limits);
}

UsdAssetBytes UsdAssets::bytes(const std::string& identifier) const {
    const auto file = std::make_shared<const FileBytes>(identifier);
    return {file, file->bytes()};
}

fs::path canonicalPath(const fs::path& path) {
    std::error_code failed; // made absolute first, for what does not exist would stay as it is
    return fs::weakly_canonical(fs::absolute(path, failed), failed);
}

std::string relativeAsset(const fs::path& file, const fs::path& layer) {
    const fs::path target = canonicalPath(file);
    const fs::path relative = target.lexically_relative(canonicalPath(layer).parent_path());
    if (relative.empty()) return target.generic_string();
    const std::string text = relative.generic_string();
    return text.starts_with("..") ? text : "./" + text;
}

} // namespace penumbra
