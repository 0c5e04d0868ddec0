// Files for the tests of the USD reader: written for one test, or lent from beside the project.
#pragma once

#include "io/usd/scene/UsdScene.h"
#include "scenegraph/Camera.h"
#include "scenegraph/Light.h"
#include "scenegraph/Mesh.h"
#include "tests/support/TemporaryFolder.h"

#include <glm/glm.hpp>

#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace penumbra {

/// The scenes that are not in the project: $PENUMBRA_SHARED, or `shared` beside the source folder.
/// Nothing if they are not there: the test then skips.
std::optional<std::filesystem::path> sharedFolder();

/// Loads `text` as the only layer of a scene; the header is put before it.
LoadedScene loadText(const std::string& text, const LoadOptions& options = {});

/// A node at one path, with its transform.
struct PlacedNode {
    const Node* node = nullptr;
    glm::dmat4 toWorld{1.0}; ///< of the node's children, or of its geometry [m]

    const Mesh* mesh() const { return dynamic_cast<const Mesh*>(node); }
    const Light* light() const { return dynamic_cast<const Light*>(node); }
    const Camera* camera() const { return dynamic_cast<const Camera*>(node); }
};

/// All nodes by their path.
std::map<std::string, PlacedNode> nodesByPath(const Scene& scene);

/// The mesh, light or camera that a prim became. Null if there is none.
const PlacedNode* leafOf(const std::map<std::string, PlacedNode>& nodes, const std::string& path);

/// How often a diagnostic with that text was raised.
std::size_t countOf(const LoadedScene& loaded, const std::string& text);

/// Area of all faces, by their Newell normals, under the linear part of `toWorld`.
double surfaceArea(const Mesh& mesh, const glm::dmat4& toWorld);

} // namespace penumbra
