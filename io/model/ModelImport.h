// Models of other formats as USD layers.
#pragma once

#include "io/model/ModelFormat.h"
#include "io/usd/layer/SceneFolders.h"
#include "io/usd/layer/UsdLayer.h"
#include "scenegraph/Scene.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace penumbra {

struct ImportOptions {
    std::optional<double> metersPerUnit = {}; ///< none: the file's, or metres if it has none
    std::optional<UpAxis> up = {};            ///< none: the file's, or the format's habit
    /// Where the layer will lie: pictures are named relative to it, and those within the model are
    /// handed over to be written beside it. Empty: the layer stays in memory, in the model's place,
    /// and names such pictures as in a package: `model.glb[picture1.png]`.
    std::filesystem::path layer = {};
    std::uintmax_t maxFileBytes = std::uintmax_t(2) << 30; ///< of each file that is read
    SceneFolders folders = {};                             ///< where those may lie
};

/// A picture that was within the model.
struct ImportedImage {
    std::string name; ///< of the file to write beside the layer, or within the model
    std::vector<std::byte> bytes;
};

struct ImportedModel {
    UsdLayer layer; ///< its diagnostics name all that was assumed or left out
    std::vector<ImportedImage> images;
    std::vector<std::filesystem::path> files; ///< that were read, the model first
    std::size_t meshes = 0, faces = 0, materials = 0, lights = 0, cameras = 0;
};

/// Reads a model (glTF, OBJ, FBX, PLY, STL, Collada) by Assimp, as a layer:
///
/// | model | USD |
/// |---|---|
/// | unit, up axis | `metersPerUnit`, `upAxis` |
/// | node | Xform with a matrix; one with meshes is of kind component |
/// | mesh | Mesh below its node: polygons as in the file, normals, st, displayColor |
/// | mesh of several nodes | a Mesh below each of them |
/// | material | Material with a UsdPreviewSurface, textures as UsdUVTexture |
/// | point and spot light | SphereLight, see ModelLight.h |
/// | camera | Camera |
///
/// Names become valid and unique names of prims; where they differ, `displayName` has the model's.
/// What has no place in it (skins, animations, lines, points, directional lights) is left out, with
/// a line each.
///
/// Throws SceneFileError, one line, if the file can't be read, is not what it claims to be (indices
/// out of range, numbers that are not finite, nodes in a circle), or has nothing to show. May be
/// called by several threads; they wait for each other.
ImportedModel importModel(const std::filesystem::path& file, const ImportOptions& options = {});

} // namespace penumbra
