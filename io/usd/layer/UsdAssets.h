// Where layers, and what they name, are found.
#pragma once

#include "io/usd/layer/UsdLayer.h"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

namespace penumbra {

/// Bytes of an asset, e.g. of a texture. They stay where they are for as long as `owner` is kept.
struct UsdAssetBytes {
    std::shared_ptr<const void> owner;
    std::span<const std::byte> bytes;
};

/// Finds and reads assets by identifier: the path of a file, or whatever a derived class makes of
/// it. This one knows files only, and layers that are text; UsdFiles knows binary layers and
/// packages as well.
class UsdAssets {
public:
    virtual ~UsdAssets() = default;

    /// The identifier of what the layer `anchor` calls `asset`: relative to the anchor's folder.
    /// \param anchor UsdLayer::file of that layer
    virtual std::string resolve(const std::string& anchor, const std::string& asset) const;
    /// The same for two identifiers of one thing.
    virtual std::string canonical(const std::string& identifier) const;
    /// The file on the disk that holds it.
    virtual std::string fileOf(const std::string& identifier) const { return identifier; }

    /// Both throw SceneFileError. The layer's `file` is its identifier.
    virtual UsdLayer layer(const std::string& identifier, const UsdLayerLimits& limits) const;
    virtual UsdAssetBytes bytes(const std::string& identifier) const;
};

/// The same for all ways to name a file: absolute and without links, as far as it exists; beyond
/// that, as it is. Empty where links lead in a circle.
std::filesystem::path canonicalPath(const std::filesystem::path& path);

/// How a layer names a file by a path relative to its own folder, beginning with a dot; the whole
/// path if there is no such way. Links are followed, and neither needs to exist.
std::string relativeAsset(const std::filesystem::path& file, const std::filesystem::path& layer);

} // namespace penumbra
