// The edges of what a lit surface was cut into.
#pragma once

#include "scenegraph/LitGeometry.h"

#include <cstdint>
#include <vector>

namespace penumbra {

/// Edges as pairs of vertices, each edge of a patch or element once.
struct MeshLines {
    std::vector<std::uint32_t> patches;  ///< outlines; none if LitMeshData::trianglePatch is empty
    std::vector<std::uint32_t> elements; ///< the other edges of elements
};

/// An element is a triangle, or a quadrilateral that was cut into two consecutive ones: the cut is
/// no edge. An outline of a patch is an edge of one of its elements alone; vertices count as the
/// same one if they lie at the same point, for elements that something touches have corners of
/// their own.
MeshLines meshLines(const LitMeshData& mesh);

} // namespace penumbra
