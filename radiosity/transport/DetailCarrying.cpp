// What rays of fine shadows met, from one meshing to the next.
#include "radiosity/transport/DetailHits.h"

#include <algorithm>
#include <iterator>

namespace penumbra {

namespace {

constexpr std::uint32_t kNew = PatchMatch::kNew;
constexpr std::uint32_t kGone = DetailHits::kGone;

/// Whether an object is drawn as it was, triangle by triangle.
bool sameDrawn(const PatchSet& before, const ObjectPart& was, const PatchSet& now,
               const ObjectPart& is) {
    if (was.elements.count != is.elements.count) return false;
    for (std::uint32_t i = 0; i < is.elements.count; ++i) {
        const Element& a = before.uncoveredElements[was.elements.first + i];
        const Element& b = now.uncoveredElements[is.elements.first + i];
        if (a.isTriangle() != b.isTriangle()) return false;
        for (std::size_t k = 0; k < 4; ++k)
            if (before.vertices[a.vertices[k]].position != now.vertices[b.vertices[k]].position)
                return false;
    }
    return true;
}

std::uint32_t renamed(std::uint32_t hit, const std::vector<std::uint32_t>& elements) {
    if (hit == Element::kNone) return hit;
    const std::uint32_t now = elements[hit & ~DetailRays::kAcross];
    return now == kGone ? kGone : now | (hit & DetailRays::kAcross);
}

} // namespace

std::vector<std::uint32_t> DetailHits::takeOver(const DetailHits& before, const PatchMatch& match) {
    if (!before.done()) return {};
    const PatchSet& was = before.patches_;
    std::vector<std::uint8_t> moved(patches_.objects.size());
    for (const ObjectId object : match.changed) moved[object.value] = 1;
    std::vector<std::uint32_t> elements(was.elements.size(), kGone);
    std::vector<Bounds> boxes(patches_.objects.size()); // before
    for (std::uint32_t o = 0; o < was.objects.size(); ++o) {
        const std::uint32_t n = match.objects[o];
        if (n == kNew) continue;
        boxes[n].add(before.boxes_[o]);
        const ObjectPart &then = was.objects[o], &now = patches_.objects[n];
        if (!moved[n]) moved[n] = !sameDrawn(was, then, patches_, now);
        for (std::uint32_t i = 0; !moved[n] && i < now.elements.count; ++i)
            elements[then.elements.first + i] = now.elements.first + i;
    }
    takeNodes(before, match.nodes, elements);
    takeVertices(before, match.vertices, elements);
    for (std::uint32_t o = 0; o < moved.size(); ++o) {
        if (!moved[o]) continue;
        dirtyNodes_.addMoved(o, boxes[o], boxes_[o]);
        dirtyVertices_.addMoved(o, boxes[o], boxes_[o]);
    }
    return elements;
}

void DetailHits::takeNodes(const DetailHits& before, std::span<const std::uint32_t> were,
                           const std::vector<std::uint32_t>& elements) {
    std::vector<Bounds> ways(dirtyNodes_.size());
    std::vector<std::uint32_t> anew(ways.size());
    for (std::uint32_t n = 0; n < were.size(); ++n) {
        const std::uint32_t was = were[n];
        if (was == kNew) {
            anew[n / kGroup] |= std::uint32_t(!isPadding(patches_.nodes[n])) << n % kGroup;
            continue;
        }
        std::ranges::transform(before.nodeHits(was), nodeHits_.begin() + std::ptrdiff_t(n) * kRays,
                               [&](std::uint32_t hit) { return renamed(hit, elements); });
        nodeNear_[n] = before.nodeNear_[was];
        nodeOpenness_[n] = before.nodeOpenness_[was];
        ways[n / kGroup].add(before.dirtyNodes_.ways(was / kGroup));
    }
    dirtyNodes_.takeOver(std::move(ways));
    for (std::uint32_t group = 0; group < anew.size(); ++group)
        if (anew[group] != 0) dirtyNodes_.add(group, anew[group]);
}

/// All are judged again: their nodes, or the middles of their elements, may be others.
void DetailHits::takeVertices(const DetailHits& before, std::span<const std::uint32_t> were,
                              const std::vector<std::uint32_t>& elements) {
    std::vector<Bounds> ways(dirtyVertices_.size());
    std::vector<std::uint32_t> anew(ways.size());
    for (std::uint32_t v = 0; v < were.size(); ++v) {
        const std::uint32_t was = were[v], group = v / kGroup;
        if (was == kNew || !takeVertex(before.groups_[was / kGroup], was, v, elements))
            anew[group] |= 1u << v % kGroup;
        else
            ways[group].add(before.dirtyVertices_.ways(was / kGroup));
    }
    dirtyVertices_.takeOver(std::move(ways));
    for (std::uint32_t group = 0; group < anew.size(); ++group)
        dirtyVertices_.add(group, anew[group]);
}

/// \return whether anything was known of it
bool DetailHits::takeVertex(const Group& before, std::uint32_t was, std::uint32_t vertex,
                            const std::vector<std::uint32_t>& elements) {
    const auto now = [&](std::uint32_t hit) { return renamed(hit, elements); };
    Group& group = groups_[vertex / kGroup];
    if (before.probed >> was % kGroup & 1) {
        std::ranges::transform(before.probes[was % kGroup], group.probes[vertex % kGroup].begin(),
                               now);
        group.probed |= 1u << vertex % kGroup;
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
