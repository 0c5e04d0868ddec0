// How much memory rows of patches may take.
#pragma once

#include "radiosity/mesh/PatchSet.h"

#include <cstddef>

namespace penumbra {

/// A block of a row of patches takes no more, but for a few [bytes]: 64 entries of 4 bytes and 4 of
/// shares, and masks.
inline constexpr std::size_t kFullBlock = 574;

/// How many times as much a row takes as its blocks are large: what the allocator adds, lists of
/// blockers, and gaps that rows in the making leave behind. Measured: office, gallery.
inline constexpr double kRowOverhead = 1.5;

/// What rows of patches may take of a budget [bytes, as RowBlock::bytes() counts]: what is left of
/// it beside all else. That is what is resident now, for nobody could add up what a scene graph,
/// its textures, Embree's trees and the libraries hold; and what fine shadows, which come after the
/// rows, will take of each vertex. Memory that was freed, and that the allocator keeps, counts as
/// taken: it is found again, but who knows when.
///
/// \param budget of the process [bytes]
/// \param rows   that there are and count as resident [bytes]
std::size_t roomForRows(std::size_t budget, std::size_t rows, const PatchSet& set);

} // namespace penumbra
