// The faces of a mesh, named and ordered by where they are.
#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace penumbra {

/// Polygons, convex and as good as flat, that share their points.
struct PolygonSoup {
    std::span<const glm::vec3> points;          ///< [m, the object's own frame]
    std::span<const std::uint32_t> corners;     ///< indices into points, face by face
    std::span<const std::uint32_t> firstCorner; ///< one a face, and one for the end
    std::span<const std::uint32_t> materials;   ///< one a face; empty: all have material 0

    std::size_t faceCount() const { return firstCorner.empty() ? 0 : firstCorner.size() - 1; }
    std::span<const std::uint32_t> cornersOf(std::size_t face) const {
        return corners.subspan(firstCorner[face], firstCorner[face + 1] - firstCorner[face]);
    }
    std::uint32_t materialOf(std::size_t face) const {
        return materials.empty() ? 0 : materials[face];
    }
};

/// The cell and the bin of normals of a face, and its address.
struct FaceKey {
    /// Of a face that is too long for a cell.
    static constexpr std::uint32_t kNoBin = 0xffffffffu;

    std::uint64_t cell = 0; ///< of its centroid, on Morton's curve: near cells are near numbers
    std::uint32_t material = 0;
    std::uint32_t bin = kNoBin; ///< of its normal
    /// Hash of its corners' positions, in their sense of rotation: a face seen from its back has
    /// another. The same of coincident faces of different materials.
    std::uint64_t address = 0;

    bool sharesCell(const FaceKey& other) const {
        return bin != kNoBin && bin == other.bin && cell == other.cell &&
               material == other.material;
    }
};

/// How faces are sorted into cells.
struct FaceGrid {
    double cell = 0.1;       ///< edge of the cells [m]; one corner of theirs is the origin
    std::uint32_t bins = 12; ///< along either axis of the octahedral map of normals; even
    double large = 0.2;      ///< faces of a greater extent are set apart [m]
};

/// The faces of a mesh in an order, and each with a first corner, that follow from their positions
/// and materials: the same for any order of points, faces and corners in the file.
struct AddressedFaces {
    std::span<const glm::vec3> points;      ///< the soup's, which must outlive this
    std::vector<std::uint32_t> source;      ///< face of the soup
    std::vector<std::uint32_t> corners;     ///< into points; of coincident points always the same
    std::vector<std::uint32_t> firstCorner; ///< one a face, and one for the end
    std::vector<FaceKey> keys;

    std::vector<std::uint32_t> large; ///< faces of the soup, by address
    /// Without area, not finite, or the same as another face of that material, seen from the same
    /// side: faces of the soup, rising.
    std::vector<std::uint32_t> dropped;

    std::size_t size() const { return source.size(); }
    std::span<const std::uint32_t> cornersOf(std::size_t face) const {
        return std::span(corners).subspan(firstCorner[face],
                                          firstCorner[face + 1] - firstCorner[face]);
    }
};

AddressedFaces addressFaces(const PolygonSoup& soup, const FaceGrid& grid);

} // namespace penumbra
