#include "radiosity/transport/NodeHits.h"

#include "base/Bits.h"
#include "radiosity/rays/Margins.h"
#include "radiosity/rays/Shaft.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

namespace penumbra {

namespace {

constexpr std::uint32_t kNew = PatchMatch::kNew;
constexpr float kFar = std::numeric_limits<float>::infinity();

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

double openness(std::uint64_t near) {
    return double(NodeHits::kRays - std::popcount(near)) / NodeHits::kRays;
}

} // namespace

std::uint32_t renamedHit(std::uint32_t hit, const std::vector<std::uint32_t>& elements) {
    // What rays of hidden things met may be gone for long.
    if (hit == Element::kNone || hit == NodeHits::kGone) return hit;
    const std::uint32_t now = elements[hit & ~DetailRays::kAcross];
    return now == NodeHits::kGone ? now : now | (hit & DetailRays::kAcross);
}

NodeHits::NodeHits(const PatchSet& patches, const RayScene& rays)
    : patches_(patches), rays_(patches, rays, patches.patchSize), boxes_(patches.objects.size()) {
    for (std::uint32_t o = 0; o < boxes_.size(); ++o) boxes_[o] = boxOf(o);
    resize();
}

void NodeHits::resize() {
    const std::size_t nodes = patches_.nodes.size();
    dirty_.resize(nodes);
    hits_.resize(nodes * kRays, Element::kNone);
    near_.resize(nodes);
    openness_.resize(nodes);
    isChanged_.resize(nodes);
}

Bounds NodeHits::boxOf(std::uint32_t object) const {
    Bounds box;
    const ObjectPart& part = patches_.objects[object];
    if (!part.present) return box;
    for (std::uint32_t e = part.elements.first; e < part.elements.end(); ++e)
        for (std::uint32_t v : patches_.uncoveredElements[e].vertices)
            box.add(patches_.vertices[v].position);
    return grown(box, std::max(patches_.skin, strayAt(patches_.farthest)));
}

NodeHits::Taken NodeHits::takeOver(const NodeHits& before, const PatchMatch& match) {
    const PatchSet& was = before.patches_;
    std::vector<std::uint8_t> moved(patches_.objects.size());
    for (const ObjectId object : match.changed) moved[object.value] = 1;
    Taken taken;
    taken.elements.assign(was.elements.size(), kGone);
    std::vector<Bounds> boxes(patches_.objects.size()); // before
    for (std::uint32_t o = 0; o < was.objects.size(); ++o) {
        const std::uint32_t n = match.objects[o];
        if (n == kNew) continue;
        boxes[n].add(before.boxes_[o]);
        const ObjectPart &then = was.objects[o], &now = patches_.objects[n];
        if (!moved[n]) moved[n] = !sameDrawn(was, then, patches_, now);
        for (std::uint32_t i = 0; !moved[n] && i < now.elements.count; ++i)
            taken.elements[then.elements.first + i] = now.elements.first + i;
    }
    takeNodes(before, match.nodes, taken.elements);
    for (std::uint32_t o = 0; o < moved.size(); ++o) {
        if (!moved[o]) continue;
        taken.moves.push_back({o, boxes[o], boxes_[o]});
        dirty_.addMoved(o, boxes[o], boxes_[o]);
    }
    return taken;
}

/// Of a node that was dirty there nothing is known.
void NodeHits::takeNodes(const NodeHits& before, std::span<const std::uint32_t> were,
                         const std::vector<std::uint32_t>& elements) {
    std::vector<Bounds> ways(dirty_.size());
    std::vector<std::uint32_t> anew(ways.size());
    for (std::uint32_t n = 0; n < were.size(); ++n) {
        const std::uint32_t was = were[n];
        if (was == kNew || before.dirty_.isDirty(was / kGroup)) {
            anew[n / kGroup] |= std::uint32_t(!isPadding(patches_.nodes[n])) << n % kGroup;
            continue;
        }
        std::ranges::transform(before.hits(was), hits_.begin() + std::ptrdiff_t(n) * kRays,
                               [&](std::uint32_t hit) { return renamedHit(hit, elements); });
        near_[n] = before.near_[was];
        openness_[n] = before.openness_[was];
        ways[n / kGroup].add(before.dirty_.ways(was / kGroup));
    }
    dirty_.takeOver(std::move(ways));
    for (std::uint32_t group = 0; group < anew.size(); ++group)
        if (anew[group] != 0) dirty_.add(group, anew[group]);
}

void NodeHits::add() {
    boxes_.resize(patches_.objects.size());
}

std::vector<NodeHits::Move> NodeHits::apply(const SceneChange& change) {
    resize();
    std::vector<Move> moves;
    for (ObjectId object : change.objects) {
        const Bounds now = boxOf(object.value);
        moves.push_back({object.value, std::exchange(boxes_[object.value], now), now});
        dirty_.addMoved(object.value, moves.back().before, now);
        dirty_.addAll(patches_.objects[object.value].nodes);
    }
    for (std::uint32_t n : change.nodes) dirty_.add(n / kGroup, 1u << n % kGroup);
    return moves;
}

void NodeHits::invalidate(const Bounds& region) {
    dirty_.addRegion(region);
}

double NodeHits::share() const {
    return dirty_.size() > 0 ? 1 - double(dirty_.left()) / double(dirty_.size()) : 1;
}

bool NodeHits::work(std::size_t effort) {
    return workOnGroups(
        dirty_, kRays, effort, count_, [&](std::uint32_t group) { return trace(group); },
        [&](std::uint32_t group, const GroupOutcome& outcome) {
            revision_ += outcome.differs;
            for (const int i : bitsOf(outcome.changed)) {
                const std::uint32_t n = group * kGroup + std::uint32_t(i);
                if (!std::exchange(isChanged_[n], std::uint8_t(1))) changed_.push_back(n);
            }
        });
}

std::vector<std::uint32_t> NodeHits::takeChanged() {
    for (std::uint32_t n : changed_) isChanged_[n] = 0;
    return std::exchange(changed_, {});
}

DetailRays::Moved NodeHits::movedOf(const DirtyGroups::Dirty& dirty) const {
    DetailRays::Moved moved;
    for (std::uint32_t object : dirty.moved) {
        moved.elements.push_back(patches_.objects[object].elements);
        if (!boxes_[object].empty()) moved.boxes.push_back(boxes_[object]);
    }
    if (!dirty.moved.empty()) moved.elements.push_back({kGone, 1});
    return moved;
}

GroupOutcome NodeHits::trace(std::uint32_t group) {
    GroupOutcome outcome;
    const DirtyGroups::Dirty& dirty = dirty_[group];
    const DetailRays::Moved moved = movedOf(dirty);
    for (std::uint32_t i = 0; i < kGroup; ++i) {
        const std::uint32_t n = group * kGroup + i;
        const Receiver& node = patches_.nodes[n];
        const auto known = std::span(hits_).subspan(std::size_t(n) * kRays, kRays);
        if (isPadding(node)) { // perhaps it was one that is not in use any more
            std::ranges::fill(known, Element::kNone);
            near_[n] = 0;
            if (std::exchange(openness_[n], 0.0) != 0) outcome.changed |= 1u << i;
            continue;
        }
        if (!isThere(patches_.nodeBlockObject[n / PatchSet::kBlock])) continue;
        DetailRays::Hits now;
        now.near = near_[n];
        std::ranges::copy(known, now.elements.begin());
        const std::uint64_t which =
            dirty.anew >> i & 1 ? DetailRays::kAllRays
                                : rays_.affected(node, DetailRays::kAllRays, known, moved, kFar);
        outcome.rays += std::uint64_t(rays_.follow(node, which, false, now));
        outcome.ways.add(now.ways);
        outcome.differs |= !std::ranges::equal(known, now.elements);
        std::ranges::copy(now.elements, known.begin());
        near_[n] = now.near;
        const double free = penumbra::openness(now.near);
        if (free != openness_[n]) outcome.changed |= 1u << i;
        openness_[n] = free;
    }
    return outcome;
}

} // namespace penumbra
