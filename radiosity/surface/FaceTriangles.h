// The faces of a mesh as they are, cut into triangles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace penumbra {

struct MeshData;

/// A run of triangles that share a material.
struct MaterialRange {
    std::uint32_t material = 0; ///< index into LitMeshData::materials
    std::size_t firstIndex = 0;
    std::size_t indexCount = 0;
};

/// The faces of a mesh as triangles, those of one material after those of another; subdivision
/// surfaces as their cages.
struct FaceTriangles {
    std::vector<std::uint32_t> indices; ///< three a triangle, into MeshData::points
    std::vector<MaterialRange> ranges;  ///< material: index into MeshData::materials
};
FaceTriangles faceTriangles(const MeshData& mesh);

} // namespace penumbra
