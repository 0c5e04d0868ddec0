#include "scenegraph/Backdrops.h"

#include <algorithm>
#include <numeric>

namespace penumbra {

std::vector<std::uint8_t> backdropsAmong(std::span<const PieceSize> pieces) {
    std::vector<std::size_t> order(pieces.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return pieces[a].area > pieces[b].area; });
    std::vector<PieceSize> smaller(pieces.size()); // all behind a piece, as one
    for (std::size_t i = order.size(); i-- > 1;) {
        smaller[i - 1] = smaller[i];
        smaller[i - 1].bounds.add(pieces[order[i]].bounds);
        smaller[i - 1].area += pieces[order[i]].area;
    }
    std::vector<std::uint8_t> backdrop(pieces.size(), 0);
    for (std::size_t i = 0; i < order.size(); ++i) {
        const PieceSize& piece = pieces[order[i]];
        const PieceSize& rest = smaller[i];
        const bool wide = rest.area > 0 && piece.area > rest.area &&
                          piece.bounds.diagonal() >= 2 * rest.bounds.diagonal();
        if (!wide) break;
        backdrop[order[i]] = 1;
    }
    return backdrop;
}

} // namespace penumbra
