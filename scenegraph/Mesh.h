// Polygons and subdivision cages.
#pragma once

#include "base/Bounds.h"
#include "scenegraph/Material.h"
#include "scenegraph/Node.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <memory>
#include <vector>

namespace penumbra {

/// How the faces of a mesh become a surface (UsdGeomMesh subdivisionScheme).
enum class SubdivisionScheme { none, bilinear, catmullClark, loop };

/// A crease: a chain of vertices along which a subdivision surface is kept sharp.
struct Crease {
    std::vector<std::int32_t>
        vertices;         ///< at least two point indices, consecutive ones share an edge
    float sharpness = 10; ///< 0 smooth ... 10 infinitely sharp (OpenSubdiv's scale)
};

/// A corner: one vertex of a subdivision surface that is kept sharp.
struct Corner {
    std::int32_t vertex = 0;
    float sharpness = 10;
};

/// What a mesh is made of. Lengths in the mesh's local frame; faces counter-clockwise seen from
/// their front. Every face has at least 3 corners, every index is in range, every point is finite:
/// the reader has seen to it.
struct MeshData {
    std::vector<glm::vec3> points;
    std::vector<std::int32_t> faceVertexCounts;  ///< corners of each face
    std::vector<std::int32_t> faceVertexIndices; ///< corners of all faces, one face after another
    SubdivisionScheme scheme = SubdivisionScheme::none;
    std::vector<Crease> creases;
    std::vector<Corner> corners;
    std::vector<std::int32_t> holes; ///< indices of faces that are not there (subdivision only)
    bool doubleSided = false;        ///< both sides reflect and are drawn
    /// Of the surface that the faces stand for, one a corner as in faceVertexIndices: unit, or zero
    /// where a corner has none. Empty: faces are as flat as they are. Not of subdivision surfaces.
    std::vector<glm::vec3> normals = {};

    std::vector<std::shared_ptr<Material>> materials; ///< at least one
    std::vector<std::uint16_t> faceMaterial; ///< index into materials; empty: all faces use 0
    /// Texture coordinates, one a corner as in faceVertexIndices; empty: no material has a texture.
    std::vector<glm::vec2> uvs = {};

    const std::shared_ptr<Material>& materialOf(std::size_t face) const {
        return materials[faceMaterial.empty() ? 0 : faceMaterial[face]];
    }
};

/// A mesh of the scene; its geometry is immutable, its materials may be edited.
class Mesh : public Node {
public:
    /// \pre data.materials is not empty; faceMaterial is empty or has one entry a face
    Mesh(std::string name, MeshData data);
    void accept(Visitor& visitor) const override;

    const MeshData& data() const { return data_; }
    /// Box around the points, hence also around the subdivision surface [local frame].
    const Bounds& bounds() const { return bounds_; }
    std::size_t faceCount() const { return data_.faceVertexCounts.size(); }
    const std::shared_ptr<Material>& materialOf(std::size_t face) const {
        return data_.materialOf(face);
    }

private:
    MeshData data_;
    Bounds bounds_;
};

} // namespace penumbra
