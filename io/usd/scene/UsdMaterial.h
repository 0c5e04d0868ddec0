// UsdShade: the constants of a material, as far as a Lambertian surface has them.
#pragma once

#include "io/usd/layer/UsdDiagnostic.h"
#include "io/usd/stage/UsdAttributes.h"
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
};

/// The materials of a stage, each made once and shared by all that is bound to it.
///
/// UsdPreviewSurface only: reflectance = diffuseColor * (1 - metallic) * opacity (without the
/// factor 1 - metallic in the specular workflow), emission = emissiveColor [nit]. Connections are
/// followed to constants; for a texture its authored fallback is used, else 0.5 for diffuseColor
/// and the input's own default for the others.
class UsdMaterials {
public:
    UsdMaterials(const UsdStage& stage, UsdTime time, Diagnostics& diagnostics)
        : stage_(stage), time_(time), diagnostics_(diagnostics) {}

    /// The surface of the material at `path`.
    const UsdSurface& at(const std::string& path);
    /// All materials that were asked for so far, by path.
    const std::unordered_map<std::string, UsdSurface>& made() const { return surfaces_; }
    /// For what has neither material nor colour: reflectance 0.5.
    const std::shared_ptr<Material>& neutral();

private:
    struct Input {
        std::vector<double> value; ///< empty: use the default
        bool texture = false;
    };

    UsdSurface make(const UsdPrim& prim);
    const UsdPrim* previewSurface(const UsdPrim& material);
    Input input(const UsdPrim& shader, const std::string& name);
    Input textureFallback(const UsdPrim& shader, const std::string& output,
                          const std::string& name);
    double number(const UsdPrim& shader, const std::string& name, double fallback);
    Rgb colour(const UsdPrim& shader, const std::string& name, Rgb fallback, Rgb ifTexture);

    const UsdStage& stage_;
    UsdTime time_;
    Diagnostics& diagnostics_;
    std::unordered_map<std::string, UsdSurface> surfaces_;
    std::shared_ptr<Material> neutral_;
};

/// The material that a prim itself is bound to: `material:binding:full`, else `material:binding`.
struct UsdBinding {
    std::string path; ///< empty: none
    bool strongerThanDescendants = false;
};
UsdBinding usdMaterialBinding(const UsdPrim& prim, Diagnostics& diagnostics);

} // namespace penumbra
