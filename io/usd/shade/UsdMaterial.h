// UsdShade: the colours of a material, as far as a Lambertian surface has them.
#pragma once

#include "io/usd/layer/UsdDiagnostic.h"
#include "io/usd/shade/UsdTextures.h"
#include "io/usd/stage/UsdAttributes.h"
#include "io/usd/stage/UsdSampleCheck.h"
#include "scenegraph/Material.h"

#include <memory>
#include <string>
#include <unordered_map>

namespace penumbra {

/// What a USD material comes to.
struct UsdSurface {
    std::shared_ptr<Material> material; ///< null if nothing in it is understood
    bool invisible = false;             ///< cut out or fully transparent: the faces are not there
    std::string shader = {};            ///< path of the UsdPreviewSurface it comes from
    std::string primvar = {};           ///< with the coordinates of its textures; empty: no texture
    UsdTextureAddress reflectance = {}; ///< where its reflectance and
    UsdTextureAddress emission = {};    ///< its emission are scales of textures
    bool covering = true; ///< its reflectance is not diminished by metallic or opacity
};

/// The materials of a stage, each made once and shared by all that is bound to it.
///
/// UsdPreviewSurface only: reflectance = diffuseColor * (1 - metallic) * opacity (without the
/// factor 1 - metallic in the specular workflow), emission = emissiveColor [nit]. Connections are
/// followed to constants, and of diffuseColor and emissiveColor to the rgb of a UsdUVTexture. Where
/// a texture can't be used its authored fallback is, else 0.5 for diffuseColor and the input's own
/// default for the others. A texture of opacity is ignored: the surface is opaque.
class UsdMaterials {
public:
    /// \param textures null: none are read, they are replaced by constants
    UsdMaterials(const UsdStage& stage, UsdTime time, Diagnostics& diagnostics,
                 UsdTextures* textures = nullptr)
        : stage_(stage), time_(time), diagnostics_(diagnostics), textures_(textures) {}

    /// The surface of the material at `path`.
    const UsdSurface& at(const std::string& path);
    /// All materials that were asked for so far, by path.
    const std::unordered_map<std::string, UsdSurface>& made() const { return surfaces_; }
    /// The primvar with the texture coordinates of one of these materials; empty: no texture.
    std::string primvarOf(const Material& material) const;
    /// For what has neither material nor colour: reflectance 0.5.
    const std::shared_ptr<Material>& neutral();

private:
    struct Input {
        std::vector<double> value; ///< empty: use the default
        bool texture = false;
        const UsdTexture* read = nullptr; ///< what the texture is, if it can be used
    };
    /// A constant, and what it is a factor of.
    struct Colour {
        Rgb factor;
        std::shared_ptr<const Texture> texture = nullptr;
        std::string primvar = {};
        UsdTextureAddress address = {};
    };

    UsdSurface make(const UsdPrim& prim);
    const UsdPrim* previewSurface(const UsdPrim& material);
    Input input(const UsdPrim& shader, const std::string& name);
    Input textureFallback(const UsdPrim& shader, const std::string& output,
                          const std::string& name);
    double number(const UsdPrim& shader, const std::string& name, double fallback);
    static Colour factored(const UsdTexture& read, float most);
    Colour colour(const UsdPrim& shader, const std::string& name, Rgb fallback, Rgb ifTexture,
                  float mostFactor);

    const UsdStage& stage_;
    UsdTime time_;
    Diagnostics& diagnostics_;
    UsdTextures* textures_;
    std::unordered_map<std::string, UsdSurface> surfaces_;
    std::shared_ptr<Material> neutral_;
};

/// Warns of what can't be used of a UsdPreviewSurface at other times than that of the load.
void checkUsdShader(const UsdStage& stage, const UsdPrim& shader, UsdSampleCheck& check);

/// The material that a prim itself is bound to: `material:binding:full`, else `material:binding`.
struct UsdBinding {
    std::string path; ///< empty: none
    bool strongerThanDescendants = false;
};
UsdBinding usdMaterialBinding(const UsdPrim& prim, Diagnostics& diagnostics);

} // namespace penumbra
