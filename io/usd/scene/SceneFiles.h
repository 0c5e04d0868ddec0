// The files of a scene: all that becomes layers.
#pragma once

#include "io/usd/crate/UsdFiles.h"

#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <vector>

namespace penumbra {

/// Files of all kinds that become layers: USD's own, and models, which are imported into memory
/// (`io/model/ModelImport.h`).
class SceneFiles : public UsdFiles {
public:
    /// \param root the scene's file: what is not in its folder, or below it, is refused unless
    ///        `allowOutside`. Sublayers of the root layer, and theirs, may lie anywhere and bring
    ///        their folders in: a layer over a scene, such as a recorded session, is put anywhere.
    explicit SceneFiles(const std::filesystem::path& root, bool allowOutside,
                        std::uintmax_t maxFileBytes = UsdLayerLimits().fileBytes);

    UsdLayer layer(const std::string& identifier, const UsdLayerLimits& limits) const override;
    /// Those of a picture within a model (`model.glb[picture1.png]`) too.
    UsdAssetBytes bytes(const std::string& identifier) const override;

    /// Layers that were read, and what models among them name: buffers, materials, pictures.
    std::vector<std::filesystem::path> withParts(std::vector<std::filesystem::path> layers) const;

private:
    UsdLayer readLayer(const std::string& identifier, const UsdLayerLimits& limits) const;

    mutable std::mutex partsMutex_;
    mutable std::set<std::string> rootLayers_; ///< canonical: the root layer and its sublayers
    mutable std::vector<std::filesystem::path> parts_;
    mutable std::set<std::string> models_; ///< canonical, that were read
    mutable std::map<std::string, std::shared_ptr<const std::vector<std::byte>>> pictures_;
};

} // namespace penumbra
