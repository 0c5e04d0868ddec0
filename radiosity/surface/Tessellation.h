// Surfaces cut into cells (patches to be) and facets (elements to be), by OpenSubdiv's Bfr.
#pragma once

#include "radiosity/surface/LimitSurface.h"
#include "radiosity/surface/SurfaceMesh.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace penumbra {

/// A parametric cell of one face: what will send light as one.
struct Cell {
    std::uint32_t face = 0;        ///< of the SurfaceMesh
    std::uint32_t firstCorner = 0; ///< outline: Tessellation::outline[first ... first + count)
    std::uint32_t cornerCount =
        0;              ///< 4 for a parametric cell (s, t in corner order (0,0) (1,0) (1,1) (0,1))
    bool whole = false; ///< a small face that was not cut: its outline is the face's own
};

/// A small quadrilateral or triangle (last two corners the same) of one cell.
struct Facet {
    std::array<std::uint32_t, 4> vertices;
    std::uint32_t cell = 0;
    std::array<glm::vec2, 4> st; ///< of the corners, within the cell
    std::array<glm::vec2, 4> uv; ///< texture coordinates of the corners, if there are any
};

/// A tessellated mesh, its fronts. Facets of neighbouring faces share the vertices on their common
/// edge wherever the surface is smooth there, so that light interpolates across it; along a crease
/// each side has vertices of its own, at the same positions: watertight either way. So it has
/// where texture coordinates differ.
struct Tessellation {
    std::vector<SurfacePoint> vertices;
    std::vector<Facet> facets;
    std::vector<Cell> cells;
    std::vector<glm::vec3> outline;
    std::vector<glm::vec2> outlineUvs; ///< as long as outline; empty: no textures
    /// Of a limit surface; else of the mesh's polygons, as of a cage that OpenSubdiv refuses.
    bool smooth = false;
    /// Faces that are left out, all of them or where they can't be lit: without area, or folded
    /// over so that one facet's corners face opposite ways.
    std::size_t leftOut = 0;
};

/// \param patchSize    longest cell edge [m]
/// \param elementSize  longest facet edge [m], about; the real size divides the edge evenly
/// A face makes no more pieces than its area holds (see EdgeRates): edges of slivers are longer.
/// Subdivision surfaces are evaluated on the limit surface. A cage that OpenSubdiv refuses is taken
/// as plain polygons. \return             the tessellation, and whether the subdivision surface was
/// understood
Tessellation tessellate(const SurfaceMesh& mesh, float patchSize, float elementSize,
                        bool& understood);

} // namespace penumbra
