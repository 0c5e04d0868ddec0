// The nodes of a model as prims, with what hangs on them.
#pragma once

#include "io/model/ModelFile.h"
#include "io/model/ModelMaterials.h"
#include "io/model/PrimNames.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

struct aiNode;

namespace penumbra {

/// The matrix of a node, column vectors.
glm::dmat4 nodeMatrix(const aiNode& node);

/// How many things became prims.
struct ModelCounts {
    std::size_t meshes = 0, faces = 0, lights = 0, cameras = 0;
};

/// Makes prims of nodes:
///
/// - A node is an Xform of kind component if it has meshes (subcomponent below another one), else
///   group. Its meshes, lights and cameras are prims below it.
/// - A node with nothing but one light or camera is that light or camera.
/// - The steps into which Assimp divides FBX transforms are multiplied and not seen.
class ModelNodes {
public:
    /// \param unit metres a unit
    ModelNodes(const ModelFile& file, double unit, ModelMaterials& materials,
               Diagnostics& diagnostics);

    /// Adds the model's root node, or what is below it if it stands for the file alone.
    /// \param rootMatrix of the root node, instead of its own
    void addTo(UsdPrimSpec& root, PrimNames names, const glm::dmat4& rootMatrix);

    const ModelCounts& counts() const { return counts_; }

private:
    /// Where a node is.
    struct Place {
        glm::dmat4 before{1}; ///< of steps above it that have no prim
        glm::dmat4 parentToWorld{1};
        bool inComponent = false;
    };
    /// What hangs on a node, besides meshes.
    struct Fittings {
        std::vector<const ModelLight*> lights;
        std::vector<const ModelCamera*> cameras;
    };

    void collectNamed();
    void addNode(UsdPrimSpec& parent, PrimNames& siblings, const aiNode& node,
                 std::optional<std::size_t> gltf, const glm::dmat4& own, const Place& place);
    void addChildren(UsdPrimSpec& spec, PrimNames& names, const aiNode& node,
                     std::optional<std::size_t> gltf, const Place& place);
    bool addAlone(UsdPrimSpec& parent, PrimNames& siblings, const aiNode& node,
                  const Fittings& fittings, const glm::dmat4& local, const glm::dmat4& toWorld,
                  const std::string& name);
    void addMeshes(UsdPrimSpec& spec, PrimNames& names, const aiNode& node);
    void addFittings(UsdPrimSpec& spec, PrimNames& names, const Fittings& fittings,
                     const glm::dmat4& toWorld);
    Fittings fittingsOf(const aiNode& node, std::optional<std::size_t> gltf) const;
    std::string nameOf(const aiNode& node, std::optional<std::size_t> gltf) const;
    SourceLocation where() const { return {file_.path().string()}; }

    const ModelFile& file_;
    double unit_;
    ModelMaterials& materials_;
    Diagnostics& diagnostics_;
    ModelCounts counts_;
    std::vector<ModelLight> lights_; // Assimp's, for formats other than glTF
    std::vector<ModelCamera> cameras_;
    std::unordered_map<const aiNode*, Fittings> byNode_;
};

} // namespace penumbra
