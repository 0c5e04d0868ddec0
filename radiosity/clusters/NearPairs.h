// Boxes that are near each other.
#pragma once

#include "base/Bounds.h"

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace penumbra {

/// Pairs every box with the `count` nearest that it may be paired with, none farther than `gap`:
/// nearest by the distance of the boxes, then of their centres, then by index. That is a function
/// of the boxes near by alone. \param mayPair asked only where a box is near enough
/// \return pairs, the lesser index first, sorted, each once
std::vector<std::array<std::uint32_t, 2>>
nearPairs(std::span<const Bounds> boxes, float gap, std::size_t count,
          const std::function<bool(std::uint32_t, std::uint32_t)>& mayPair);

} // namespace penumbra
