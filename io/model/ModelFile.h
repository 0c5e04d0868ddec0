// A model as Assimp reads it: the one place that runs Assimp.
#pragma once

#include "base/FileBytes.h"
#include "io/model/GltfJson.h"
#include "io/model/ModelFormat.h"
#include "io/usd/layer/SceneFolders.h"
#include "io/usd/layer/UsdDiagnostic.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string_view>
#include <vector>

struct aiScene;

namespace penumbra {

/// Which files of a model are opened.
struct ModelLimits {
    std::uintmax_t fileBytes; ///< of each
    SceneFolders folders;     ///< where they may lie
};

/// A model that was read and checked: see checkModel().
class ModelFile {
public:
    /// Throws SceneFileError, also for what crashes Assimp: it is tried in a copy of the process
    /// first. Assimp's own warnings become diagnostics.
    ModelFile(std::filesystem::path file, ModelFormat format, const ModelLimits& limits,
              Diagnostics& diagnostics);
    ~ModelFile();

    const std::filesystem::path& path() const { return file_; }
    std::string_view bytes() const; ///< of the file itself
    ModelFormat format() const { return format_; }
    const aiScene& scene() const { return *scene_; }
    const Gltf& gltf() const { return gltf_; } ///< empty if it is none
    std::size_t animations() const { return animations_; }
    /// All files that were read, the model itself first.
    std::vector<std::filesystem::path> files() const;

private:
    struct Reader;
    const aiScene* tryAndRead(const ModelLimits& limits, Diagnostics& diagnostics);

    std::filesystem::path file_;
    ModelFormat format_;
    FileBytes source_;
    Gltf gltf_;
    std::size_t animations_ = 0;
    std::unique_ptr<Reader> reader_; // owns the scene
    const aiScene* scene_ = nullptr;
};

} // namespace penumbra
