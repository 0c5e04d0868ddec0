#include "radiosity/transport/DetailHits.h"

#include "base/Bits.h"
#include "radiosity/mesh/Interpolation.h"
#include "radiosity/rays/Margins.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>

namespace penumbra {

namespace {

constexpr int kProbes = DetailRays::kProbes;
constexpr float kFar = std::numeric_limits<float>::infinity();
/// In a slit light is gathered this far on the way from the vertex to the middle of its elements.
constexpr float kInward = 0.5f;
constexpr std::size_t kVertexRays = 32; ///< that a fresh vertex takes, about

double smoothstep(double low, double high, double x) {
    const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

double openness(std::uint64_t near, int rays) {
    return double(rays - std::popcount(near)) / rays;
}

} // namespace

/// One vertex, and what is known of it.
struct DetailHits::Visit {
    std::uint32_t vertex = 0;
    const Receiver& receiver;
    double expected = 0; ///< openness that the nodes let expect
    bool anew = false;
    const Group& known;
    const DetailRays::Moved& moved;
};

DetailHits::DetailHits(const PatchSet& patches, NodeHits& nodes)
    : patches_(patches), nodes_(nodes), rays_(nodes.rays()),
      fans_(fansOf(patches.uncoveredElements, patches.vertices.size())), nodePatches_(patches) {
    resize();
}

void DetailHits::resize() {
    dirty_.resize(patches_.vertices.size());
    groups_.resize(patches_.vertices.size() / kGroup);
}

void DetailHits::add(std::span<const ObjectId> objects) {
    for (const ObjectId object : objects) {
        const ObjectPart& part = patches_.objects[object.value];
        fans_.add(patches_.uncoveredElements, part.elements, part.vertices);
        nodePatches_.add(part.patches, part.nodes);
    }
}

void DetailHits::apply(const SceneChange& change, std::span<const NodeHits::Move> moves) {
    resize();
    for (const auto& [object, before, now] : moves) {
        dirty_.addMoved(object, before, now);
        dirty_.addAll(patches_.objects[object].vertices);
    }
    for (std::uint32_t v : change.vertices) dirty_.add(v / kGroup, 1u << v % kGroup);
    for (std::uint32_t p : change.patches) revisit(p, true);
    for (std::uint32_t p : change.parted) revisitLit(p);
}

void DetailHits::invalidate(const Bounds& region) {
    dirty_.addRegion(region);
}

/// Has the vertices of a patch judged again: nodes see more or less, or slits have other middles.
void DetailHits::revisit(std::uint32_t index, bool slitsOnly) {
    const Patch& patch = patches_.patches[index];
    for (std::uint32_t i = 0; i < patch.elementCount; ++i) {
        const std::uint32_t e = patches_.patchElements[patch.firstElement + i];
        for (const auto* elements : {&patches_.elements, &patches_.uncoveredElements})
            for (std::uint32_t v : (*elements)[e].vertices) {
                const auto& known = groups_[v / kGroup].gatherers;
                if (!slitsOnly || std::any_of(known.begin(), known.end(),
                                              [](const Gatherer& g) { return g.slit; }))
                    dirty_.add(v / kGroup, 0);
            }
    }
}

/// The same of all vertices that its nodes light.
void DetailHits::revisitLit(std::uint32_t index) {
    revisit(index, false);
    for (const std::uint32_t p : patches_.clustersNear(patches_.patches[index])) revisit(p, false);
}

/// The same for all patches of nodes that see more or less.
void DetailHits::judgeChanged() {
    std::vector<std::uint32_t> patches;
    for (const std::uint32_t n : nodes_.takeChanged()) {
        const auto more = nodePatches_.of(n);
        patches.insert(patches.end(), more.begin(), more.end());
    }
    std::sort(patches.begin(), patches.end());
    patches.erase(std::unique(patches.begin(), patches.end()), patches.end());
    for (const std::uint32_t p : patches) revisitLit(p);
}

double DetailHits::share() const {
    return dirty_.size() > 0 ? 1 - double(dirty_.left()) / double(dirty_.size()) : 1;
}

std::size_t DetailHits::vertexCount() const {
    std::size_t count = 0;
    for (const Group& group : groups_)
        count += std::size_t(std::count_if(group.gatherers.begin(), group.gatherers.end(),
                                           [](const Gatherer& g) { return g.weighs(); }));
    return count;
}

bool DetailHits::work(std::size_t effort) {
    assert(nodes_.done());
    if (nodes_.anyChanged()) judgeChanged();
    return workOnGroups(
        dirty_, kVertexRays, effort, count_, [&](std::uint32_t group) { return trace(group); },
        [](std::uint32_t, const GroupOutcome&) {});
}

GroupOutcome DetailHits::trace(std::uint32_t group) {
    GroupOutcome outcome;
    if (patches_.isBlended(group * kGroup / PatchSet::kBlock)) return outcome;
    const DirtyGroups::Dirty& dirty = dirty_[group];
    const DetailRays::Moved moved = nodes_.movedOf(dirty);
    if (!dirty.judge && !anyAffected(group, moved)) return outcome;
    const Group known = std::move(groups_[group]);
    Group& out = groups_[group] = {};
    for (std::uint32_t i = 0; i < kGroup; ++i) {
        const std::uint32_t v = group * kGroup + i;
        const PatchCoordinate& at = patches_.vertexCoordinates[v];
        if (at.patch == Element::kNone ||
            !nodes_.isThere(patches_.vertexBlockObject[v / PatchSet::kBlock]))
            continue;
        const double expected = interpolateNodes<double>(patches_, at, nodes_.openness());
        follow(
            {v, patches_.vertices[v].receiver, expected, (dirty.anew >> i & 1) != 0, known, moved},
            out, outcome);
    }
    out.fit();
    return outcome;
}

/// Whether any ray of a group's vertices may meet something else.
bool DetailHits::anyAffected(std::uint32_t group, const DetailRays::Moved& moved) const {
    const Group& known = groups_[group];
    const auto affects = [&](const Receiver& receiver, std::uint64_t which,
                             std::span<const std::uint32_t> hits, float reach) {
        return rays_.affected(receiver, which, hits, moved, reach) != 0;
    };
    for (const Gatherer& gatherer : known.gatherers) {
        const Receiver& receiver = patches_.vertices[gatherer.vertex].receiver;
        const auto hits = std::span(known.hits).subspan(gatherer.first);
        if (affects(receiver, DetailRays::kAllRays, hits.first(kRays), kFar)) return true;
        if (gatherer.slit && affects({gatherer.inside, receiver.normal}, DetailRays::kAllRays,
                                     hits.subspan(kRays, kRays), kFar))
            return true;
    }
    for (const std::uint32_t slot : bitsOf(known.probed)) {
        if (affects(patches_.vertices[group * kGroup + slot].receiver, DetailRays::kAllProbes,
                    known.probesOf(slot), patches_.patchSize))
            return true;
    }
    return false;
}

const DetailHits::Gatherer* DetailHits::Group::find(std::uint32_t vertex) const {
    for (const Gatherer& gatherer : gatherers)
        if (gatherer.vertex == vertex) return &gatherer;
    return nullptr;
}

/// Finds out by the first rays whether a vertex is in question.
void DetailHits::follow(const Visit& at, Group& out, GroupOutcome& outcome) const {
    const std::uint32_t slot = at.vertex % kGroup;
    const Gatherer* const before = at.anew ? nullptr : at.known.find(at.vertex);
    const bool probed = !at.anew && (at.known.probed >> slot & 1);
    DetailRays::Hits hits;
    std::uint64_t which = DetailRays::kAllProbes;
    if (before) {
        const auto known = std::span(at.known.hits).subspan(before->first, kRays);
        std::copy(known.begin(), known.end(), hits.elements.begin());
        hits.near = before->near;
        which = rays_.affected(at.receiver, DetailRays::kAllRays, known, at.moved, kFar);
    } else if (probed) {
        const auto& known = at.known.probesOf(slot);
        std::copy(known.begin(), known.end(), hits.elements.begin());
        for (std::size_t r = 0; r < known.size(); ++r)
            hits.near |= std::uint64_t(known[r] != Element::kNone) << r;
        which = rays_.affected(at.receiver, which, known, at.moved, patches_.patchSize);
    }
    outcome.rays += std::uint64_t(rays_.follow(at.receiver, which, true, hits));
    const double guess = openness(hits.near & DetailRays::kAllProbes, kProbes);
    if (std::abs(guess - at.expected) < 0.03 && guess > 0.5) {
        // Rays that meet nothing near matter no farther.
        auto& probes = out.addProbes(slot);
        for (std::size_t r = 0; r < probes.size(); ++r)
            probes[r] = hits.near >> r & 1 ? hits.elements[r] : Element::kNone;
        const glm::vec3 reach(patches_.patchSize);
        outcome.ways.add(Bounds{at.receiver.position - reach, at.receiver.position + reach});
        return;
    }
    if (!before) {
        which = probed ? DetailRays::kAllRays : ~DetailRays::kAllProbes;
        outcome.rays += std::uint64_t(rays_.follow(at.receiver, which, true, hits));
    }
    gather(at, hits, out, outcome);
}

/// Finds out by all rays how much of what they gather counts.
void DetailHits::gather(const Visit& at, DetailRays::Hits& hits, Group& out,
                        GroupOutcome& outcome) const {
    Gatherer gatherer;
    gatherer.vertex = at.vertex;
    gatherer.near = hits.near;
    gatherer.first = std::uint32_t(out.hits.size());
    const double open = openness(hits.near, kRays);
    gatherer.detail = float(smoothstep(0.01, 0.04, std::abs(open - at.expected)));
    gatherer.shut = float(1 - smoothstep(0.25, 0.45, open));
    out.hits.insert(out.hits.end(), hits.elements.begin(), hits.elements.end());
    outcome.ways.add(hits.ways);
    gatherer.slit = inSlit(hits.elements);
    if (gatherer.slit) {
        // At its rim a slit is light, but for the least part of an element.
        Receiver inside = at.receiver;
        const glm::vec3 middle = middleAround(at.vertex);
        const glm::vec3 over = middle + hoverAt(patches_.skin, middle) * at.receiver.normal;
        inside.position = glm::mix(at.receiver.position, over, kInward);
        const Gatherer* const before = at.anew ? nullptr : at.known.find(at.vertex);
        DetailRays::Hits from;
        std::uint64_t which = DetailRays::kAllRays;
        if (before && before->slit && before->inside == inside.position) {
            const auto known = std::span(at.known.hits).subspan(before->first + kRays, kRays);
            std::copy(known.begin(), known.end(), from.elements.begin());
            which = rays_.affected(inside, which, known, at.moved, kFar);
        }
        outcome.rays += std::uint64_t(rays_.follow(inside, which, true, from));
        outcome.ways.add(from.ways);
        out.hits.insert(out.hits.end(), from.elements.begin(), from.elements.end());
        gatherer.detail = 0, gatherer.shut = 1;
        gatherer.inside = inside.position;
    }
    out.gatherers.push_back(gatherer);
}

/// The mean of the middles of a vertex's elements [m, world].
glm::vec3 DetailHits::middleAround(std::uint32_t vertex) const {
    glm::vec3 sum(0);
    int count = 0;
    const auto add = [&](std::uint32_t e) {
        const Element& element = patches_.elements[e];
        const std::size_t corners = element.isTriangle() ? 3 : 4;
        glm::vec3 middle(0);
        int times = 0;
        for (std::size_t k = 0; k < corners; ++k) {
            middle += patches_.vertices[element.vertices[k]].position / float(corners);
            times += element.vertices[k] == vertex;
        }
        for (; times > 0; --times) sum += middle, ++count;
    };
    if (vertex >= patches_.firstPrivate)
        add(patches_.privateElement[vertex - patches_.firstPrivate]);
    else
        for (std::uint32_t corner : fans_.at(vertex)) add(corner / 4);
    return count > 0 ? sum / float(count) : sum;
}

} // namespace penumbra
