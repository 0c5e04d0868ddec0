// What is selected in a scene.
#pragma once

#include "radiosity/query/SceneRays.h"
#include "scenegraph/Light.h"
#include "scenegraph/Material.h"
#include "scenegraph/Scene.h"
#include "scenegraph/Transform.h"

#include <memory>
#include <string>
#include <vector>

namespace penumbra {

/// An object that somebody clicked on, and the surface of it.
struct Selection {
    ObjectId object;
    std::string objectPath;                     ///< "/": what belongs to no object
    std::string path;                           ///< of the mesh or light that was clicked on
    glm::dvec3 position{0.0}, normal{0.0};      ///< where, when it was clicked [m, world]
    std::shared_ptr<Transform> node;            ///< that begins the object, and moves it with what
                                                ///< is below; null: nothing does, it stays
    std::shared_ptr<Material> material;         ///< of the face; null: of a light
    std::vector<std::shared_ptr<Light>> lights; ///< all lights of the object

    /// Whether there is something to be dimmed: lights, or a surface that emits.
    bool emits() const { return !lights.empty() || (material && material->emissive()); }
};

/// The selection of what a ray touched.
Selection selectionOf(const Scene& scene, const PlacedScene& placed, const Touch& touch);

/// The lights of an object.
std::vector<std::shared_ptr<Light>> lightsOf(const Scene& scene, const PlacedScene& placed,
                                             ObjectId object);

/// Every light of the scene, each once.
std::vector<std::shared_ptr<Light>> allLights(const Scene& scene, const PlacedScene& placed);

/// Turns the frame of an object into the matrix of its node.
/// \param objectToWorld where the object is now, by the node's matrix as it is now
/// \param wanted        where it is to be; a pure shift leaves the axes of the matrix as they are
glm::dmat4 matrixFor(const Transform& node, const glm::dmat4& objectToWorld,
                     const glm::dmat4& wanted);

} // namespace penumbra
