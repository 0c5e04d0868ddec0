// Ground planes and backdrops: what reaches far beyond the rest of a scene.
#pragma once

#include "base/Bounds.h"

#include <cstdint>
#include <span>
#include <vector>

namespace penumbra {

/// How large a piece of a scene is.
struct PieceSize {
    Bounds bounds;   ///< [m, world]
    double area = 0; ///< [m^2]
};

/// Which pieces are backdrops, 1 each. From the largest area on, a piece is one as long as it has
/// more area than all smaller ones together and is at least twice as wide (by the diagonals of the
/// boxes around them). What is left, if anything was there, is never nothing.
std::vector<std::uint8_t> backdropsAmong(std::span<const PieceSize> pieces);

} // namespace penumbra
