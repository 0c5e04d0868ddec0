// Which faces share an edge.
#pragma once

#include "radiosity/clusters/AddressedFaces.h"

#include <array>
#include <cstdint>
#include <vector>

namespace penumbra {

/// Pairs of faces that share an edge, the lesser first, in no order. Of several faces at one edge
/// each one and the next. Takes linear time: edges are found in buckets, one a point.
std::vector<std::array<std::uint32_t, 2>> facesAtEdges(const AddressedFaces& faces);

} // namespace penumbra
