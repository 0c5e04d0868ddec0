// Where in a file the nodes of a scene come from: what it takes to write about them.
#pragma once

#include "io/usd/shade/UsdTextureAddress.h"
#include "scenegraph/Camera.h"
#include "scenegraph/Light.h"
#include "scenegraph/Material.h"
#include "scenegraph/Transform.h"

#include <memory>
#include <string>
#include <vector>

namespace penumbra {

/// The prims of what can be edited in a loaded scene.
struct UsdAddresses {
    struct TransformAddress {
        std::shared_ptr<Transform> node;
        std::string prim;
        bool animated = false; ///< the file moves it
        bool apart = false;    ///< its object is its own shapes: below it are objects by themselves
    };
    struct Choice {
        std::shared_ptr<Switch> node;
        std::string prim;
    };
    struct LightAddress {
        std::shared_ptr<Light> light;   ///< one of
        std::shared_ptr<Material> tube; ///< the two, of a CylinderLight
        std::string prim;
    };
    struct Paint {
        std::shared_ptr<Material> material;
        std::string shader;              ///< of a Material prim; empty: it has none
        std::vector<std::string> meshes; ///< then those that are painted with it alone
        /// Of textures that nothing else reads: where the factors are written as their scales.
        UsdTextureAddress reflectance = {}, emission = {};
        bool covering = true; ///< see UsdSurface
    };
    struct Eye {
        std::shared_ptr<Camera> node;
        std::string prim;
    };

    /// Something that was added, removed or hidden since the file was read.
    struct Presence {
        std::shared_ptr<Group> parent;
        NodePtr node;       ///< a child of `parent`, or not
        std::string prim;   ///< empty: it has none, and can't be written about
        std::string source; ///< the prim that it is a copy of; empty: it is in the file
    };

    std::vector<TransformAddress> transforms;
    std::vector<Choice> choices;
    std::vector<LightAddress> lights;
    std::vector<Paint> paints;
    std::vector<Eye> eyes;
    std::vector<Presence> presences; ///< one a node
    std::string defaultPrim;         ///< its name; empty: none
};

} // namespace penumbra
