// Which element a ray has met: rays see few large triangles, light is kept by many small elements.
#pragma once

#include "base/ObjectId.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace penumbra {

struct PatchSet;
struct RayHit;

/// The elements on both sides of an object's triangles for rays (RayMesh). Where a triangle lies on
/// many of them, as on a wall, a grid says which come into question at a point.
///
/// Elements are numbers among those of their object, and lengths are in its stretched frame: poses
/// change nothing here.
struct RayElements {
    static constexpr std::uint32_t kNone = 0xffffffffu;
    static constexpr std::uint32_t kMany = 0x80000000u; ///< marks the index of a grid, or of a list

    /// Where a plane is divided into the cells of a grid, of equal size.
    struct Plane {
        glm::vec3 origin{}, across{}, along{}; ///< axes in units of a cell [1/m]
    };
    /// One side of a triangle on a grid.
    struct Grid {
        glm::vec2 first{}, u{}, v{}; ///< its first corner and its edges, in cells
        std::uint32_t columns = 1, lines = 1;
        std::uint32_t bin = 0; ///< of the first cell, line by line
        std::uint32_t plane = 0;
    };
    /// Two a triangle, front and back: the element there, kNone, or a grid.
    std::vector<std::uint32_t> sides;
    std::vector<Grid> grids;
    std::vector<Plane> planes;
    std::vector<std::uint32_t> bins;  ///< the element on a cell, kNone, or a list
    std::vector<std::uint32_t> lists; ///< how many, and then the elements that meet a cell
};

/// Whose elements lie on a side of a triangle for rays.
struct RaySide {
    static constexpr std::uint32_t kAll = 0xffffffffu;
    std::uint32_t firstCell = 0, cellCount = 1; ///< see CellElements
    std::uint32_t which = kAll;                 ///< of the cells' elements, if they have any
};

/// Elements cell by cell: those of cell c are elements[first[c] ... first[c + 1]).
struct CellElements {
    std::vector<std::uint32_t> first, elements;
};

/// Fills in the rayElements of an object, and which sides of its triangles are lit.
/// \param set    has elements, and vertices in the object's stretched frame
/// \param sides  two a triangle of the object's, front and back
void findRayElements(PatchSet& set, ObjectId object, std::span<const RaySide> sides,
                     const CellElements& cells);

/// The element that a ray has met. Where it ends on an edge between elements it is one of them,
/// always the same. kNone: none, or a side that is not lit.
std::uint32_t elementAt(const PatchSet& set, const RayHit& hit);

} // namespace penumbra
