// What Assimp does not hand on of a glTF file: its JSON, as far as that is needed.
#pragma once

#include "io/model/ModelCamera.h"
#include "io/model/ModelLight.h"
#include "io/model/TextureTransform.h"

#include <glm/glm.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace penumbra {

/// A node, by its number in the file.
struct GltfNode {
    std::string name; ///< may be empty
    std::vector<std::size_t> children;
    std::optional<std::size_t> light, camera; ///< into Gltf::lights and Gltf::cameras
};

/// What a material says of one of its textures.
struct GltfTextureUse {
    GltfTextureTransform transform;
    std::optional<std::size_t> texCoord; ///< of the transform, in place of the texture's own

    friend bool operator==(const GltfTextureUse&, const GltfTextureUse&) = default;
};

struct GltfMaterial {
    std::string name;
    glm::dvec3 emissive{0};
    double strength = 1; ///< KHR_materials_emissive_strength
    GltfTextureUse baseUse, emissiveUse;
};

/// Assimp 5.2 gives a light or a camera to one node only, knows no emissive strength, and turns and
/// scales texture coordinates around the middle.
struct Gltf {
    std::vector<GltfNode> nodes;
    std::vector<std::size_t> roots; ///< of the scene that is shown
    std::vector<ModelLight> lights; ///< KHR_lights_punctual [cd]; frames as ModelLight has them
    std::vector<ModelCamera> cameras;
    std::vector<GltfMaterial> materials;
    std::vector<std::string> required; ///< extensions without which the file can't be shown
};

/// Reads .gltf or .glb of version 2; what is older comes back empty. Throws SceneFileError if it is
/// no JSON, if nodes are in a circle or too deep, or if a number points to what is not there.
/// \param bytes all of the file
Gltf readGltf(const std::filesystem::path& file, std::string_view bytes);

} // namespace penumbra
