// A mesh node from checked polygons and what the prim says about its surface.
#pragma once

#include "io/usd/scene/UsdPolygons.h"
#include "io/usd/shade/UsdMaterial.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace penumbra {

/// What a gprim gets from its ancestors.
struct UsdInherited {
    std::string material;             ///< path of the bound material; empty: none
    bool materialIsStronger = false;  ///< an ancestor's binding overrules those below
    std::optional<Rgb> displayColour; ///< constant primvar
    bool operator==(const UsdInherited&) const = default;
};

/// The light of a mesh (MeshLightAPI), added to its materials.
struct UsdMeshLight {
    struct Paint {
        std::shared_ptr<Material> plain;   ///< may be on other meshes that are no light
        std::shared_ptr<Material> glowing; ///< a copy that sends the light, too
    };
    std::vector<Paint> paints;

    /// Paints again if a plain material or the luminance [nit] has changed. A material's own glow
    /// tints the light, if there is one.
    void set(Rgb luminance) const;
};

/// Makes the mesh of a gprim; null, with a warning, if no face is left. Each face takes the first
/// of
///
/// 1. the material of the GeomSubset it is in,
/// 2. the material bound to the prim (`inherited` already accounts for it),
/// 3. primvars:displayColor: constant, uniform, or the mean of the face's corners,
/// 4. the neutral material.
///
/// \param name  of the node
/// \param light null if it is none; gets its paints, which send nothing yet
NodePtr makeUsdMesh(const std::string& name, const UsdStage& stage, const UsdAttributes& prim,
                    UsdPolygons polygons, const UsdInherited& inherited, UsdMaterials& materials,
                    UsdMeshLight* light, Diagnostics& diagnostics);

/// The prim's own displayColor if it is constant: what it hands down to its descendants.
std::optional<Rgb> usdConstantColour(const UsdAttributes& prim);

/// Sum of the kept faces' areas under a linear map (polygons by their Newell normals).
double areaOf(const UsdPolygons& polygons, const glm::dmat3& toWorld);

} // namespace penumbra
