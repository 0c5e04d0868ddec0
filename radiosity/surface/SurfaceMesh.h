// A placed mesh made ready for tessellation: clean convex faces in world space, and which of its
// sides there are.
#pragma once

#include "radiosity/surface/ClosedPart.h"
#include "scenegraph/Mesh.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace penumbra {

/// One face of a SurfaceMesh.
struct SurfaceFace {
    std::uint32_t firstCorner = 0; ///< SurfaceMesh::corners[first ... first + count)
    std::uint32_t cornerCount = 0;
    std::uint32_t source = 0; ///< face of the scene's mesh that it comes from
    bool front = true;        ///< whether its front and its back receive light
    bool back = false;
    bool solid = false; ///< belongs to a closed surface with nothing lit inside
};

/// Faces in world space. Concave and twisted polygons are triangulated (not in subdivision cages).
struct SurfaceMesh {
    const MeshData* data = nullptr;
    std::vector<glm::vec3> points;      ///< [m, world]
    std::vector<std::uint32_t> corners; ///< indices into points, face by face
    std::vector<SurfaceFace> faces;
    std::vector<glm::vec2> uvs;     ///< texture coordinates, one a corner; empty: no textures
    std::vector<glm::vec3> normals; ///< of MeshData, one a corner: unit or zero; empty: none
    std::size_t skipped = 0;        ///< faces that can't be used
    std::size_t used = 0;           ///< faces of the scene's mesh that were used

    std::span<const std::uint32_t> cornersOf(const SurfaceFace& face) const {
        return std::span(corners).subspan(face.firstCorner, face.cornerCount);
    }
    std::span<const glm::vec2> uvsOf(const SurfaceFace& face) const {
        return uvs.empty() ? std::span<const glm::vec2>()
                           : std::span(uvs).subspan(face.firstCorner, face.cornerCount);
    }
    std::span<const glm::vec3> normalsOf(const SurfaceFace& face) const {
        return normals.empty() ? std::span<const glm::vec3>()
                               : std::span(normals).subspan(face.firstCorner, face.cornerCount);
    }
    const Material& materialOf(const SurfaceFace& face) const {
        return *data->materialOf(face.source);
    }
    /// Loop cages are taken as the polygons they are.
    bool subdivided() const {
        return data->scheme == SubdivisionScheme::catmullClark ||
               data->scheme == SubdivisionScheme::bilinear;
    }
};

/// Places a mesh. A mirroring transform turns the winding round, so that fronts stay fronts.
SurfaceMesh placeSurface(const MeshData& data, const glm::dmat4& toWorld);

/// Decides which sides of the faces there are. Of a closed connected surface that contains none of
/// `lightPoints` only the outside is ever lit. An open two-sided surface, or a closed one with a
/// light inside, has both sides; a one-sided surface has its front. So has a room; but one that no
/// light is in may as well be a model turned inside out, and has both sides. A surface whose only
/// opening is flat and lies on a face of the same object is closed. \param lightPoints points on
/// every emitter [m, in the mesh's frame] \param object the meshes of the same rigid object, in the
/// same frame; this one may be among them
void chooseSides(SurfaceMesh& mesh, std::span<const glm::vec3> lightPoints,
                 std::span<const SurfaceMesh* const> object = {});

/// The closed connected parts of a mesh. \param object see chooseSides()
std::vector<ClosedPart> closedParts(const SurfaceMesh& mesh,
                                    std::span<const SurfaceMesh* const> object = {});

/// Normal of a polygon, its length twice the area (Newell's method; sound for twisted polygons).
glm::dvec3 newellNormal(std::span<const glm::vec3> points, std::span<const std::uint32_t> corners);

} // namespace penumbra
