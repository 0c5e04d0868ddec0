// What rays of fine shadows met, from one meshing to the next.
#include "radiosity/transport/DetailHits.h"

#include <algorithm>
#include <iterator>

namespace penumbra {

bool DetailHits::takeOver(const DetailHits& before, const PatchMatch& match,
                          const NodeHits::Taken& taken) {
    if (!before.done()) return false;
    takeVertices(before, match.vertices, taken.elements);
    for (const auto& [object, was, now] : taken.moves) dirty_.addMoved(object, was, now);
    return true;
}

/// All are judged again: their nodes, or the middles of their elements, may be others.
void DetailHits::takeVertices(const DetailHits& before, std::span<const std::uint32_t> were,
                              const std::vector<std::uint32_t>& elements) {
    std::vector<Bounds> ways(dirty_.size());
    std::vector<std::uint32_t> anew(ways.size());
    for (std::uint32_t v = 0; v < were.size(); ++v) {
        const std::uint32_t was = were[v], group = v / kGroup;
        if (was == PatchMatch::kNew || !takeVertex(before.groups_[was / kGroup], was, v, elements))
            anew[group] |= 1u << v % kGroup;
        else
            ways[group].add(before.dirty_.ways(was / kGroup));
    }
    dirty_.takeOver(std::move(ways));
    for (std::uint32_t group = 0; group < anew.size(); ++group) dirty_.add(group, anew[group]);
}

/// \return whether anything was known of it
bool DetailHits::takeVertex(const Group& before, std::uint32_t was, std::uint32_t vertex,
                            const std::vector<std::uint32_t>& elements) {
    const auto now = [&](std::uint32_t hit) { return renamedHit(hit, elements); };
    Group& group = groups_[vertex / kGroup];
    if (before.probed >> was % kGroup & 1) {
        std::ranges::transform(before.probesOf(was % kGroup),
                               group.addProbes(vertex % kGroup).begin(), now);
        return true;
    }
    const Gatherer* const known = before.find(was);
    if (!known) return false;
    Gatherer gatherer = *known;
    gatherer.vertex = vertex;
    gatherer.first = std::uint32_t(group.hits.size());
    const auto hits =
        std::span(before.hits).subspan(known->first, std::size_t(kRays) * (known->slit ? 2 : 1));
    std::ranges::transform(hits, std::back_inserter(group.hits), now);
    group.gatherers.push_back(gatherer);
    return true;
}

} // namespace penumbra
