// The pictures that materials of a model name.
#pragma once

#include "io/model/ModelImport.h"
#include "io/usd/layer/UsdDiagnostic.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

struct aiScene;
struct aiTexture;

namespace penumbra {

/// Finds pictures: beside the model, under the names that models carry (also paths of the machine
/// on which they were made), or within it.
class ImportedImages {
public:
    /// \param layer where the layer will lie; empty: in memory, in the model's place
    ImportedImages(const aiScene& scene, std::filesystem::path model, std::filesystem::path layer,
                   Diagnostics& diagnostics);

    /// The path to write into the layer, relative to it; nothing, with a warning, if there is no
    /// such picture. \param name as the model has it
    std::optional<std::string> find(const std::string& name);

    /// Those within the model: to be written beside the layer, or, if it stays in memory, what
    /// `model.glb[name]` stands for.
    std::vector<ImportedImage> take() { return std::move(images_); }
    /// Those beside the model that were found.
    const std::vector<std::filesystem::path>& files() const { return files_; }

private:
    std::optional<std::string> search(const std::string& name);
    std::optional<std::string> take(const std::filesystem::path& file, const std::string& name);
    std::optional<std::string> keep(const aiTexture& texture, const std::string& name);

    const aiScene& scene_;
    std::filesystem::path model_, layer_;
    Diagnostics& diagnostics_;
    std::map<std::string, std::optional<std::string>> known_;
    std::vector<ImportedImage> images_;
    std::vector<std::filesystem::path> files_;
};

} // namespace penumbra
