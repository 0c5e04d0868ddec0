#include "io/usd/crate/UsdFiles.h"

#include "base/FileBytes.h"
#include "io/usd/crate/CrateLayer.h"
#include "io/usd/crate/UsdPackage.h"
#include "io/usd/crate/UsdPackagePath.h"

#include <algorithm>

namespace penumbra {

namespace {

std::string_view beginOf(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), std::min<std::size_t>(bytes.size(), 8)};
}

[[noreturn]] void refuse(const std::string& identifier, const std::string& why) {
    throw SceneFileError({identifier, 0, 0}, why);
}

} // namespace

struct UsdFiles::OpenPackage {
    UsdAssetBytes asset;
    UsdPackage contents;
};

UsdFiles::UsdFiles(std::uintmax_t maxFileBytes, SceneFolders folders)
    : maxFileBytes_(maxFileBytes), folders_(std::move(folders)) {}
UsdFiles::~UsdFiles() = default;

SceneFolders UsdFiles::folders() const {
    const std::lock_guard lock(mutex_);
    return folders_;
}

void UsdFiles::allowFolderOf(const std::string& identifier) const {
    const std::lock_guard lock(mutex_);
    folders_.add(fileOf(identifier));
}

std::string UsdFiles::canonical(const std::string& identifier) const {
    const std::string file = fileOf(identifier);
    return UsdAssets::canonical(file) + identifier.substr(file.size());
}

std::string UsdFiles::fileOf(const std::string& identifier) const {
    return std::string(outermostPackage(identifier));
}

std::shared_ptr<const UsdFiles::OpenPackage>
UsdFiles::package(const std::string& identifier) const {
    const std::string key = canonical(identifier);
    {
        const std::lock_guard lock(mutex_);
        const auto found = packages_.find(key);
        if (found != packages_.end()) return found->second;
    }
    UsdAssetBytes asset = read(identifier, maxFileBytes_);
    if (!isUsdPackage(beginOf(asset.bytes))) refuse(identifier, "this is no package");
    UsdPackage contents(asset.bytes, identifier);
    auto opened = std::make_shared<OpenPackage>(OpenPackage{std::move(asset), std::move(contents)});
    const std::lock_guard lock(mutex_);
    return packages_.try_emplace(key, std::move(opened)).first->second;
}

UsdAssetBytes UsdFiles::read(const std::string& identifier, std::uintmax_t maxBytes) const {
    const auto inside = splitPackagePath(identifier);
    if (!inside) {
        if (!folders().hold(identifier))
            refuse(identifier, "not opened: outside the scene's folder (--allow-outside opens it)");
        const auto file = std::make_shared<const FileBytes>(identifier, maxBytes);
        return {file, file->bytes()};
    }
    if (packageDepth(identifier) > kMaxPackageDepth)
        refuse(identifier, "packages are nested too deeply");
    const auto opened = package(inside->package);
    const UsdPackage::Entry* entry = opened->contents.find(inside->name);
    if (!entry) refuse(identifier, "there is no such file in the package");
    return {opened, opened->contents.bytes(*entry)};
}

UsdAssetBytes UsdFiles::bytes(const std::string& identifier) const {
    return read(identifier, maxFileBytes_);
}

UsdLayer UsdFiles::layer(const std::string& identifier, const UsdLayerLimits& limits) const {
    const UsdAssetBytes asset = read(identifier, limits.fileBytes);
    const std::string_view begin = beginOf(asset.bytes);
    if (isUsdPackage(begin)) {
        const auto opened = package(identifier);
        const std::string root =
            joinPackagePath(identifier, opened->contents.entries().front().name);
        if (!splitPackagePath(root))
            refuse(identifier, "this is a package (its name should end in .usdz)");
        return layer(root, limits);
    }
    if (isCrate(begin)) return readCrateLayer(asset.bytes, identifier, limits);
    return parseUsdLayer({reinterpret_cast<const char*>(asset.bytes.data()), asset.bytes.size()},
                         identifier, limits);
}

bool UsdFiles::has(const std::string& packageName, const std::string& name) const {
    try {
        return package(packageName)->contents.find(name) != nullptr;
    } catch (const SceneFileError&) {
        return false;
    }
}

// From the layer, from the root layer, then as if the package itself had named it.
std::string UsdFiles::resolveInside(const std::string& packageName, const std::string& name,
                                    const std::string& asset) const {
    const auto found = [&](const std::string& from) -> std::optional<std::string> {
        // A package in the package: its own part of the path comes first.
        const auto nested = splitPackagePath(asset);
        auto path = pathInPackage(from, nested ? fileOf(asset) : asset);
        if (!path || !has(packageName, *path)) return std::nullopt;
        return *path + (nested ? asset.substr(fileOf(asset).size()) : "");
    };
    auto path = found(name);
    if (!path && !asset.starts_with('.')) {
        const auto opened = package(packageName);
        path = found(opened->contents.entries().front().name);
    }
    return path ? joinPackagePath(packageName, *path) : resolve(packageName, asset);
}

std::string UsdFiles::resolve(const std::string& anchor, const std::string& asset) const {
    const auto inside = splitPackagePath(anchor);
    if (!inside || asset.starts_with('/')) return UsdAssets::resolve(anchor, asset);
    return resolveInside(inside->package, inside->name, asset);
}

UsdLayer readAnyUsdLayer(const std::filesystem::path& file, const UsdLayerLimits& limits) {
    return UsdFiles(limits.fileBytes).layer(file.string(), limits);
}

} // namespace penumbra
