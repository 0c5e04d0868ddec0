// Materials of models as materials of USD.
#pragma once

#include "io/model/ImportedImages.h"
#include "io/model/ModelFile.h"
#include "io/model/PrimNames.h"

#include <glm/glm.hpp>

#include <optional>
#include <string>
#include <vector>

struct aiMaterial;
struct aiMesh;

namespace penumbra {

/// Makes a Material with a UsdPreviewSurface of each of Assimp's that a mesh uses:
///
/// | model | UsdPreviewSurface |
/// |---|---|
/// | base colour (glTF), else diffuse colour | diffuseColor, or scale of its texture (glTF, OBJ) |
/// | its texture | UsdUVTexture; fallback: half of the colour, for who reads no textures |
/// | KHR_texture_transform (glTF) | UsdTransform2d; elsewhere the coordinates are transformed |
/// | emission, times its strength | emissiveColor [cd/m2]; formats other than glTF have no unit |
/// | its texture | the same, its fallback is dark |
/// | metallic | metallic; 0 if a picture says where |
/// | roughness | roughness |
/// | opacity (glTF: times the alpha of the base colour's texture) | opacity, opacityThreshold |
///
/// Colours are taken as linear, as they are in the file.
class ModelMaterials {
public:
    /// \param scope absolute path of the prim that will hold the materials
    ModelMaterials(const ModelFile& file, std::string scope, ImportedImages& images,
                   Diagnostics& diagnostics);

    /// Path of the material of a mesh. Empty if the file gives it none, so that its own colours, or
    /// a neutral grey, are seen.
    std::string pathFor(const aiMesh& mesh);
    /// Whether both sides of a mesh are shown.
    bool doubleSided(const aiMesh& mesh) const;

    /// The prims of all materials asked for, in that order.
    std::vector<UsdPrimSpec> take() { return std::move(prims_); }
    std::size_t count() const { return prims_.size(); }

private:
    struct Texture;
    struct Surface;

    bool says(const aiMaterial& material, const aiMesh& mesh) const;
    Surface surfaceOf(const aiMaterial& material);
    void nameOtherPictures(const aiMaterial& material, const std::string& name);
    double metallicOf(const aiMaterial& material, const std::string& name);
    glm::dvec3 emissionOf(const aiMaterial& material, const GltfMaterial& json);
    GltfMaterial jsonOf(const aiMaterial& material);
    std::optional<Texture> textureOf(const aiMaterial& material, std::initializer_list<int> types,
                                     const GltfTextureUse& use);
    static void addTexture(UsdPrimSpec& material, const std::string& path, const std::string& name,
                           const Texture& used, glm::dvec4 scale, glm::dvec4 fallback);
    UsdPrimSpec prim(const Surface& surface, const std::string& name);

    const ModelFile& file_;
    std::string scope_;
    ImportedImages& images_;
    Diagnostics& diagnostics_;
    PrimNames names_;
    std::vector<std::optional<std::string>> paths_; // by Assimp's index
    std::vector<UsdPrimSpec> prims_;
    bool emissionNamed_ = false;
};

} // namespace penumbra
