// Loading a scene, USD or a model, into the scene graph.
#pragma once

#include "base/LightRequest.h"
#include "io/usd/layer/UsdDiagnostic.h"
#include "io/usd/scene/UsdAddresses.h"
#include "io/usd/scene/UsdAnimation.h"
#include "scenegraph/Scene.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

namespace penumbra {

struct LoadOptions {
    /// Time code at which the scene is read; none: the file's startTimeCode, or, if it has none,
    /// the attributes' defaults.
    std::optional<double> time = {};
    std::uintmax_t maxFileBytes = std::uintmax_t(2) << 30; ///< of one layer
    std::size_t maxInstanced = 250'000; ///< nodes that PointInstancers may make, in all
    /// Whether what the scene names is opened wherever it lies: see SceneFiles.
    bool allowOutside = false;
};

struct LoadedScene {
    LoadOptions options; ///< that it was read with
    std::shared_ptr<Scene> scene;
    std::shared_ptr<UsdAnimation> animation; ///< plays the file's time samples; null: nothing moves
    LightRequest asked;                      ///< what the file asks of the light
    std::vector<Diagnostic> diagnostics;     ///< what was not understood or left out; see summary()
    UsdAddresses addresses;                  ///< where in the file the nodes come from
    /// All layers, also sublayers that could not be understood, the file itself first; then what
    /// models name: buffers, materials, pictures.
    std::vector<std::filesystem::path> files;
};

/// Reads a scene as a scene graph: USD of any kind, or a model of another format, which is imported
/// into a layer in memory (`io/model/ModelImport.h`), also where it is a sublayer. Below the root
/// everything is in metres, in the file's own axes: if its unit is another, the root is a Transform
/// that scales.
///
/// | USD | scene graph |
/// |---|---|
/// | Xform | Transform |
/// | Scope, prims without or of unknown type | Group |
/// | Mesh, Cube, Sphere, Cylinder, Cone, Capsule, Plane | Mesh |
/// | RectLight, DiskLight, SphereLight | Light |
/// | CylinderLight | Mesh, emitting |
/// | Camera | Camera |
/// | Material with a UsdPreviewSurface | Material, shared |
/// | PointInstancer | Group or Transform, with a Transform `instance_17` for each instance |
///
/// Instances share nodes: all of a prototype's, and the meshes below instanceable prims of the same
/// contents. A prototype stands where its instances are, and is drawn in place only if it is not
/// below its instancer. Its own transform becomes part of the instances', unless an object begins
/// there.
///
/// Each prim's first node carries its name, and what else comes of the prim has none, so that paths
/// are those of the file: a mesh, light or camera with xformOps of its own becomes a Transform that
/// holds a nameless node. What is inactive, invisible, abstract, only `over`, or of purpose proxy
/// or guide is left out.
///
/// An object begins at a prim that moves, comes or goes with time, or for which `bool
/// penumbra:movable` is true; it is one with all that is below it. Where that is false, it is not
/// one. Elsewhere UsdObjects finds the objects.
///
/// The default prim's `double penumbra:patchSize` and `penumbra:elementSize`, in units of the file,
/// `double penumbra:residual`, and the tokens `penumbra:trigger` and `penumbra:order` become
/// LoadedScene::asked.
///
/// Throws SceneFileError if the file can't be read at all.
LoadedScene loadUsdScene(const std::filesystem::path& file, const LoadOptions& options = {});

} // namespace penumbra
