// What is in view and not hidden, read from an item buffer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace penumbra {

/// An item buffer says for each sample of the picture which item is in front there. It comes from a
/// renderer or from rays, and may be much coarser than the picture: what it misses is then small.
constexpr std::uint32_t kNoItem = ~std::uint32_t(0); ///< nothing there

/// About how many pixels of the picture each item covers.
///
/// \param buffer  an item a sample: below `items`, or kNoItem; the samples lie evenly
/// \param items   how many items there are
/// \param pixels  of the whole picture
/// \return        one value an item [pixels]; 0: not seen at any sample
///
/// Weghorst, Hooper & Greenberg, "Improved computational methods for ray tracing", ACM TOG 3(1),
/// 1984 (the item buffer).  [docs/references.md]
std::vector<float> seenPixels(std::span<const std::uint32_t> buffer, std::size_t items,
                              double pixels);

} // namespace penumbra
