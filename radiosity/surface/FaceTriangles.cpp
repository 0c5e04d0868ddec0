#include "radiosity/surface/FaceTriangles.h"

#include "radiosity/surface/Triangulate.h"
#include "scenegraph/Mesh.h"

#include <algorithm>
#include <utility>

namespace penumbra {

namespace {

bool isHole(const MeshData& mesh, std::size_t face) {
    return std::find(mesh.holes.begin(), mesh.holes.end(), std::int32_t(face)) != mesh.holes.end();
}

/// Indices of a face's triangles, appended.
void appendFace(const MeshData& mesh, std::size_t first, std::size_t count,
                std::vector<std::uint32_t>& indices) {
    const auto begin = mesh.faceVertexIndices.begin() + std::ptrdiff_t(first);
    const std::vector<std::uint32_t> corners(begin, begin + std::ptrdiff_t(count));
    if (count == 3) {
        indices.insert(indices.end(), corners.begin(), corners.end());
        return;
    }
    for (const auto& triangle : triangulate(mesh.points, corners))
        indices.insert(indices.end(), triangle.begin(), triangle.end());
}

} // namespace

FaceTriangles faceTriangles(const MeshData& mesh) {
    std::vector<std::vector<std::uint32_t>> byMaterial(mesh.materials.size());
    std::size_t first = 0;
    for (std::size_t face = 0; face < mesh.faceVertexCounts.size(); ++face) {
        const auto count = std::size_t(mesh.faceVertexCounts[face]);
        const std::size_t material = mesh.faceMaterial.empty() ? 0 : mesh.faceMaterial[face];
        if (!isHole(mesh, face)) appendFace(mesh, first, count, byMaterial[material]);
        first += count;
    }
    FaceTriangles triangles;
    for (std::size_t material = 0; material < byMaterial.size(); ++material) {
        const std::vector<std::uint32_t>& indices = byMaterial[material];
        if (indices.empty()) continue;
        triangles.ranges.push_back(
            {std::uint32_t(material), triangles.indices.size(), indices.size()});
        triangles.indices.insert(triangles.indices.end(), indices.begin(), indices.end());
    }
    return triangles;
}

} // namespace penumbra
