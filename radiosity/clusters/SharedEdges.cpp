#include "radiosity/clusters/SharedEdges.h"

#include <algorithm>

namespace penumbra {

namespace {

/// Calls visit(lesser point, greater point, face) for every edge of every face.
template <class Visit>
void forEachEdge(const AddressedFaces& faces, const Visit& visit) {
    for (std::size_t face = 0; face < faces.size(); ++face) {
        const auto corners = faces.cornersOf(face);
        std::uint32_t from = corners.back();
        for (std::uint32_t to : corners) {
            visit(std::min(from, to), std::max(from, to), std::uint32_t(face));
            from = to;
        }
    }
}

} // namespace

std::vector<std::array<std::uint32_t, 2>> facesAtEdges(const AddressedFaces& faces) {
    // Buckets by the lesser point, filled from their ends.
    std::vector<std::uint32_t> begin(faces.points.size() + 1, 0);
    forEachEdge(faces, [&](std::uint32_t a, std::uint32_t, std::uint32_t) { ++begin[a]; });
    std::uint32_t sum = 0;
    for (std::uint32_t& count : begin) count = sum += count;
    struct Use {
        std::uint32_t point, face;
    };
    std::vector<Use> uses(faces.corners.size());
    forEachEdge(faces, [&](std::uint32_t a, std::uint32_t b, std::uint32_t face) {
        uses[--begin[a]] = {b, face};
    });

    std::vector<std::array<std::uint32_t, 2>> pairs;
    pairs.reserve(uses.size() / 2);
    for (std::size_t point = 0; point + 1 < begin.size(); ++point) {
        const auto first = uses.begin() + begin[point], last = uses.begin() + begin[point + 1];
        std::sort(first, last, [](const Use& a, const Use& b) {
            return a.point != b.point ? a.point < b.point : a.face < b.face;
        });
        for (auto use = first; use != last && use + 1 != last; ++use)
            if (use[0].point == use[1].point && use[0].face != use[1].face)
                pairs.push_back({use[0].face, use[1].face});
    }
    return pairs;
}

} // namespace penumbra
