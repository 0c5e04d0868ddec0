// Which of the open work comes first.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace penumbra {

/// The `count` most valuable pieces of open work, the most valuable first; equals by index, so that
/// the order is the same wherever it is computed. Work that is worth nothing is left out.
/// \param worth expected gain of each piece, in any one unit, >= 0
std::vector<std::uint32_t> highestPriorities(std::span<const double> priority, std::size_t count);

} // namespace penumbra
