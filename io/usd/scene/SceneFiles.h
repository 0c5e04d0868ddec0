// The files of a scene: all that becomes layers.
#pragma once

#include "io/usd/crate/UsdFiles.h"

#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace penumbra {

/// Files of all kinds that become layers: USD's own, and models, which are imported into memory
/// (`io/model/ModelImport.h`).
class SceneFiles : public UsdFiles {
public:
    explicit SceneFiles(std::uintmax_t maxFileBytes = UsdLayerLimits().fileBytes)
        : UsdFiles(maxFileBytes) {}

    UsdLayer layer(const std::string& identifier, const UsdLayerLimits& limits) const override;
    /// Those of a picture within a model (`model.glb[picture1.png]`) too, once its layer was read.
    UsdAssetBytes bytes(const std::string& identifier) const override;

    /// What the models that were read name: their buffers, materials and pictures.
    std::vector<std::filesystem::path> parts() const;

private:
    mutable std::mutex partsMutex_;
    mutable std::vector<std::filesystem::path> parts_;
    mutable std::map<std::string, std::shared_ptr<const std::vector<std::byte>>> pictures_;
};

} // namespace penumbra
