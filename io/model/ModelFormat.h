// The formats of models that are imported, and what they leave unsaid.
#pragma once

#include <filesystem>
#include <optional>

namespace penumbra {

enum class ModelFormat { gltf, obj, fbx, ply, stl, collada };

/// By the ending of the name, in any case: gltf, glb, obj, fbx, ply, stl, dae. Nothing for others.
std::optional<ModelFormat> modelFormatOf(const std::filesystem::path& file);

/// As people call it.
const char* nameOf(ModelFormat format);

} // namespace penumbra
