// The edits of a walkthrough, saved as a layer.
#pragma once

#include "io/usd/scene/UsdScene.h"
#include "viewer/input/SceneEdit.h"

#include <filesystem>
#include <string>
#include <vector>

namespace penumbra {

/// Writes what is edited in a scene now as a layer over its file; the scene stays as it is.
/// \param history all edits since the file was read
/// \return names of what can't be written in a layer, see UsdRecording::missed()
/// \throws Error if it can't be written
std::vector<std::string> saveEdits(const LoadedScene& scene, const std::filesystem::path& file,
                                   EditHistory history, const std::filesystem::path& layer);

/// `name`-edited.usda, or, where that is there already, `name`-edited-2.usda and so on.
std::string freeEditsName(const std::string& name);

} // namespace penumbra
