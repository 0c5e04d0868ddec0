// Which pieces of work have the highest priorities.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace penumbra {

/// The `count` pieces of work of the highest priority, the highest first; equals by index, so that
/// the order is the same wherever it is computed. Work of priority 0 is left out.
/// \param priority expected gain of each piece, in any one unit, >= 0
std::vector<std::uint32_t> highestPriorities(std::span<const double> priority, std::size_t count);

} // namespace penumbra
