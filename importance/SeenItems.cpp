#include "importance/SeenItems.h"

#include <cassert>

namespace penumbra {

std::vector<float> seenPixels(std::span<const std::uint32_t> buffer, std::size_t items,
                              double pixels) {
    std::vector<float> seen(items);
    if (buffer.empty()) return seen;
    const auto each = float(pixels / double(buffer.size()));
    for (std::uint32_t item : buffer) {
        if (item == kNoItem) continue;
        assert(item < items);
        seen[item] += each;
    }
    return seen;
}

} // namespace penumbra
