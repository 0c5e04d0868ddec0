// The scene as a list of placed things, grouped into rigid objects.
#pragma once

#include "base/Bounds.h"
#include "base/ObjectId.h"
#include "scenegraph/Scene.h"

#include <glm/glm.hpp>

#include <string>
#include <vector>

namespace penumbra {

class Mesh;
class Light;
class Camera;

/// A rigid piece of the scene: one Transform with what is below it, until the next Transform that
/// begins an object. What is below none of them belongs to the object at the root, path "/".
struct Object {
    std::string path;        ///< of the transform that begins it
    glm::dmat4 toWorld{1.0}; ///< its frame
    bool visible = true;     ///< false if a Switch above its transform hides all of it
};

/// A node at one path, with its transform. The pointers live as long as the scene.
template <class T>
struct Placed {
    const T* node = nullptr;
    glm::dmat4 toWorld{1.0};  ///< of the node's own frame
    glm::dmat4 toObject{1.0}; ///< of the node's own frame to its object's
    ObjectId object;
    std::string path;
};

/// What is in a scene, in traversal order, with instances written out.
struct PlacedScene {
    std::vector<Object> objects;
    std::vector<Placed<Mesh>> meshes;
    std::vector<Placed<Light>> lights;
    std::vector<Placed<Camera>> cameras;
    Bounds bounds; ///< of visible meshes and lights [m, world]
};

/// Lists a scene. An object begins at a Transform that says so, within another object as well, and,
/// outside of any object, at a Transform that directly holds a mesh or a light (through plain
/// groups, not through further Transforms). Objects without geometry are not listed, nor is what a
/// Switch hides, except for whole objects: they are listed as not visible, since they may come
/// back.
PlacedScene placeScene(const Scene& scene);

/// Whether a scene has anything that may give light, switched on or not: a light, or a material
/// that emits.
bool hasLights(const PlacedScene& scene);

} // namespace penumbra
