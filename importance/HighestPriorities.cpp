#include "importance/HighestPriorities.h"

#include <algorithm>

namespace penumbra {

std::vector<std::uint32_t> highestPriorities(std::span<const double> priority, std::size_t count) {
    std::vector<std::uint32_t> order;
    for (std::uint32_t i = 0; i < priority.size(); ++i)
        if (priority[i] > 0) order.push_back(i);
    count = std::min(count, order.size());
    std::partial_sort(order.begin(), order.begin() + std::ptrdiff_t(count), order.end(),
                      [&](std::uint32_t a, std::uint32_t b) {
                          return priority[a] != priority[b] ? priority[a] > priority[b] : a < b;
                      });
    order.resize(count);
    return order;
}

} // namespace penumbra
