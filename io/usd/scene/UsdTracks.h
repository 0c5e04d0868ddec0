// The nodes of a loaded scene whose prims have time samples.
#pragma once

#include "io/usd/scene/UsdAnimation.h"
#include "io/usd/scene/UsdFrame.h"
#include "io/usd/scene/UsdMesh.h"
#include "io/usd/shade/UsdMaterial.h"
#include "io/usd/stage/UsdAttributes.h"
#include "io/usd/stage/UsdStage.h"
#include "scenegraph/Camera.h"
#include "scenegraph/Light.h"
#include "scenegraph/Transform.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace penumbra {

/// Whether a prim's visibility says that it and all below it is hidden.
bool usdHidden(const UsdAttributes& attributes);

/// Remembers which prim each changing node came from, and reads those prims again at other times.
class UsdTracks : public UsdAnimation {
public:
    /// \param textures all that the materials have
    UsdTracks(std::shared_ptr<const UsdStage> stage, std::shared_ptr<UsdTextures> textures)
        : stage_(std::move(stage)), textures_(std::move(textures)) {}
    void setTime(double timeCode) override;
    bool empty() const;
    /// Warns of samples that can't be used. \param loaded when the scene was read; that is reported
    void warnOfSamples(UsdTime loaded, Diagnostics& diagnostics) const;

    /// Remembers a node whose matrix changes with time, after those above it.
    /// \param parent what is left behind by `!resetXformStack!`
    /// \param size   of a light that it resizes, if it does: see usdLightSize(), as loaded
    void addTransform(std::shared_ptr<Transform> node, const UsdPrim& prim, const UsdFrame& parent,
                      std::optional<glm::dvec3> size);
    /// \param node hides what `prim` became; always remembered
    void addSwitch(std::shared_ptr<Switch> node, const UsdPrim& prim);
    /// Remembers a light if its prim changes with time or its frame moves: what a light of a given
    /// flux sends depends on its size in the world. \param node a Light, or the Mesh that
    /// represents a CylinderLight, of the size that it has at the time of `loaded`
    void addLight(const NodePtr& node, const UsdAttributes& loaded, const UsdFrame& frame);
    /// Remembers the light of a mesh, in case that also its materials change.
    void addMeshLight(UsdMeshLight light, const UsdPrim& prim, const UsdFrame& frame,
                      UsdPolygons polygons);
    /// Remembers a camera if its prim changes with time.
    void addCamera(std::shared_ptr<Camera> node, const UsdPrim& prim);
    /// The materials that were made, those that change.
    void addMaterials(const UsdMaterials& materials);

private:
    struct TransformTrack {
        std::shared_ptr<Transform> node;
        const UsdPrim* prim;
        UsdFrame parent;
        std::optional<glm::dvec3> size; ///< of a light, see addTransform()
    };
    struct LightTrack {
        std::shared_ptr<Light> light;   ///< or
        std::shared_ptr<Material> tube; ///< the material of a CylinderLight's mesh
        UsdAttributes loaded;
        UsdFrame frame;
    };
    struct MeshLightTrack {
        UsdMeshLight light;
        const UsdPrim* prim;
        UsdFrame frame;
        UsdPolygons polygons; ///< of the load: points are held
        bool changes;         ///< by itself
    };
    struct SwitchTrack {
        std::shared_ptr<Switch> node;
        const UsdPrim* prim;
    };
    struct CameraTrack {
        std::shared_ptr<Camera> node;
        const UsdPrim* prim;
    };
    struct MaterialTrack {
        std::shared_ptr<Material> material;
        std::string path, shader; ///< of its prims
    };

    void setTransforms(double timeCode);
    void setLights(double timeCode);
    void setMaterials(double timeCode);

    std::shared_ptr<const UsdStage> stage_; // the prims live in it
    std::shared_ptr<UsdTextures> textures_;
    std::vector<TransformTrack> transforms_;
    std::vector<SwitchTrack> switches_;
    std::vector<LightTrack> lights_;
    std::vector<MeshLightTrack> meshLights_;
    std::vector<CameraTrack> cameras_;
    std::vector<MaterialTrack> materials_;
};

} // namespace penumbra
