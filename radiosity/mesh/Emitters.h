// What sends light first: area lights, and faces that shine.
#pragma once

#include "radiosity/mesh/PatchSet.h"
#include "radiosity/surface/SurfaceMesh.h"
#include "radiosity/surface/Tessellation.h"
#include "scenegraph/Mesh.h"

#include <glm/glm.hpp>

#include <span>
#include <vector>

namespace penumbra {

class Light;
class Material;

/// The light's surface in its own frame, black and emitting: a quadrilateral, a disk of 64 corners
/// or a sphere of 24 x 12 faces. It blocks rays and is drawn; the light it sends is that of the
/// exact shape, see lightEmitter().
MeshData lightShapeMesh(const Light& light);

/// The light as a sender, in world space. A disk or sphere that `toWorld` stretches unevenly
/// becomes polygons.
Emitter lightEmitter(const Light& light, const glm::dmat4& toWorld);

/// Emissive faces that send as one, of one material. The emitter has no object and no path.
struct FaceEmitter {
    Emitter emitter;
    const Material* material = nullptr;
};
/// The emissive faces of a mesh as senders [frame of the mesh]. Of a subdivision surface they are
/// cells.
std::vector<FaceEmitter> faceEmitters(const SurfaceMesh& mesh, const Tessellation& tessellation,
                                      float patchSize);

/// Along a polygon's normal, to where its corners go counter-clockwise; as long as its area [m^2].
glm::dvec3 areaVector(std::span<const glm::vec3> polygon);
/// Area of a polygon, exact if it is planar [m^2].
double polygonArea(std::span<const glm::vec3> polygon);

} // namespace penumbra
