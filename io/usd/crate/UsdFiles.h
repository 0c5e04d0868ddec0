// Layers and assets of every kind that we read: text, binary, in packages.
#pragma once

#include "io/usd/layer/SceneFolders.h"
#include "io/usd/layer/UsdAssets.h"

#include <map>
#include <mutex>

namespace penumbra {

class UsdPackage;

/// Finds layers and assets in files and in packages. The kind of a layer is told by its content:
/// `PXR-USDC`, a zip's `PK`, else text. `a.usdz[b/c.usd]` is the file b/c.usd in the package
/// a.usdz, and packages may be in packages: `a.usdz[b.usdz[c.usd]]`. The identifier of a package
/// alone stands for its first file, the root layer.
///
/// What a layer in a package names by a relative path is looked for from that layer, then, unless
/// it begins with a dot, from the package's root layer, then outside, beside the package.
///
/// Packages are mapped, read in place, and kept open for as long as this lives. May be used by
/// several threads.
class UsdFiles : public UsdAssets {
public:
    /// \param folders where files may lie; others are refused when they are read
    explicit UsdFiles(std::uintmax_t maxFileBytes = UsdLayerLimits().fileBytes,
                      SceneFolders folders = {});
    ~UsdFiles() override;

    std::string resolve(const std::string& anchor, const std::string& asset) const override;
    std::string canonical(const std::string& identifier) const override;
    std::string fileOf(const std::string& identifier) const override;
    UsdLayer layer(const std::string& identifier, const UsdLayerLimits& limits) const override;
    UsdAssetBytes bytes(const std::string& identifier) const override;

protected:
    /// Where files may lie.
    SceneFolders folders() const;
    /// Allows the folder of one more file.
    void allowFolderOf(const std::string& identifier) const;

private:
    struct OpenPackage;
    std::shared_ptr<const OpenPackage> package(const std::string& identifier) const;
    UsdAssetBytes read(const std::string& identifier, std::uintmax_t maxBytes) const;
    bool has(const std::string& package, const std::string& name) const;
    std::string resolveInside(const std::string& package, const std::string& name,
                              const std::string& asset) const;

    std::uintmax_t maxFileBytes_;
    mutable std::mutex mutex_;
    mutable SceneFolders folders_;
    mutable std::map<std::string, std::shared_ptr<const OpenPackage>> packages_;
};

/// A layer from one file, whatever its kind.
UsdLayer readAnyUsdLayer(const std::filesystem::path& file, const UsdLayerLimits& limits = {});

} // namespace penumbra
