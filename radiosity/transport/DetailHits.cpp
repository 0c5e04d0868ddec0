#include "radiosity/transport/DetailHits.h"

#include "base/Bits.h"
#include "base/Parallel.h"
#include "radiosity/mesh/Interpolation.h"
#include "radiosity/rays/Margins.h"
#include "radiosity/rays/Shaft.h"
#include "radiosity/schedule/WorkCosts.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace penumbra {

namespace {

constexpr int kProbes = DetailRays::kProbes;
constexpr float kFar = std::numeric_limits<float>::infinity();
/// In a slit light is gathered this far on the way from the vertex to the middle of its elements.
constexpr float kInward = 0.5f;
constexpr std::size_t kNodeRays = 64, kVertexRays = 32; ///< that a fresh receiver takes, about
constexpr std::size_t kGroupsATask = 2;

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

DetailHits::DetailHits(const PatchSet& patches)
    : patches_(patches), surface_(patches), rays_(patches, surface_, patches.patchSize),
      fans_(fansOf(patches.uncoveredElements, patches.vertices.size())), nodePatches_(patches),
      boxes_(patches.objects.size()) {
    for (std::uint32_t o = 0; o < boxes_.size(); ++o) boxes_[o] = boxOf(o);
    resize();
}

void DetailHits::resize() {
    dirtyNodes_.resize(patches_.nodes.size());
    dirtyVertices_.resize(patches_.vertices.size());
    nodeHits_.resize(patches_.nodes.size() * kRays, Element::kNone);
    nodeNear_.resize(patches_.nodes.size());
    nodeOpenness_.resize(patches_.nodes.size());
    groups_.resize(patches_.vertices.size() / kGroup);
}

Bounds DetailHits::boxOf(std::uint32_t object) const {
    Bounds box;
    const ObjectPart& part = patches_.objects[object];
    if (!part.present) return box;
    for (std::uint32_t e = part.elements.first; e < part.elements.end(); ++e)
        for (std::uint32_t v : patches_.uncoveredElements[e].vertices)
            box.add(patches_.vertices[v].position);
    return grown(box, std::max(patches_.skin, strayAt(patches_.farthest)));
}

void DetailHits::apply(const SceneChange& change) {
    surface_.follow(change.objects);
    resize();
    for (ObjectId object : change.objects) {
        const Bounds before = boxes_[object.value];
        const Bounds& now = boxes_[object.value] = boxOf(object.value);
        dirtyNodes_.addMoved(object.value, before, now);
        dirtyVertices_.addMoved(object.value, before, now);
        dirtyNodes_.addAll(patches_.objects[object.value].nodes);
        dirtyVertices_.addAll(patches_.objects[object.value].vertices);
    }
    for (std::uint32_t n : change.nodes) dirtyNodes_.add(n / kGroup, 1u << n % kGroup);
    for (std::uint32_t v : change.vertices) dirtyVertices_.add(v / kGroup, 1u << v % kGroup);
    for (std::uint32_t p : change.patches) revisit(p, true);
    for (std::uint32_t p : change.parted) revisit(p, false);
}

void DetailHits::invalidate(const Bounds& region) {
    dirtyNodes_.addRegion(region);
    dirtyVertices_.addRegion(region);
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
                    dirtyVertices_.add(v / kGroup, 0);
            }
    }
}

double DetailHits::share() const {
    const double all = double(dirtyNodes_.size() + dirtyVertices_.size());
    return all > 0 ? 1 - double(dirtyNodes_.left() + dirtyVertices_.left()) / all : 1;
}

std::size_t DetailHits::vertexCount() const {
    std::size_t count = 0;
    for (const Group& group : groups_)
        count += std::size_t(std::count_if(group.gatherers.begin(), group.gatherers.end(),
                                           [](const Gatherer& g) { return g.weighs(); }));
    return count;
}

bool DetailHits::work(std::size_t effort) {
    // Vertices are judged by what their nodes see.
    return workOnNodes(effort) || workOnVertices(effort);
}

bool DetailHits::workOnNodes(std::size_t effort) {
    return workOn(dirtyNodes_, kNodeRays, effort,
                  [&](std::uint32_t group) { return traceNodes(group); });
}

bool DetailHits::workOnVertices(std::size_t effort) {
    return workOn(dirtyVertices_, kVertexRays, effort,
                  [&](std::uint32_t group) { return traceVertices(group); });
}

/// How many rays an edit concerns can't be known before: a few groups at a time.
/// \param rays about how many a receiver needs of which nothing is known
template <class Trace>
bool DetailHits::workOn(DirtyGroups& dirty, std::size_t rays, std::size_t effort,
                        const Trace& trace) {
    const std::size_t few = std::max<std::size_t>(effort / 16, 256);
    if (dirty.done()) return false;
    for (std::size_t spent = 0; spent < effort && !dirty.done();) {
        const auto groups = dirty.next(few, rays);
        std::vector<Outcome> outcomes(groups.size());
        parallelFor(groups.size(), kGroupsATask, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) outcomes[i] = trace(groups[i]);
        });
        std::vector<Bounds> ways;
        for (std::size_t i = 0; i < outcomes.size(); ++i) {
            rayCount_ += outcomes[i].rays;
            spent += cost::kDetailVisit + outcomes[i].rays;
            ways.push_back(outcomes[i].ways);
            for (const int node : bitsOf(outcomes[i].changed))
                for (const std::uint32_t p :
                     nodePatches_.of(groups[i] * kGroup + std::uint32_t(node)))
                    revisit(p, false);
        }
        groupsVisited_ += ways.size();
        dirty.clean(ways);
    }
    return true;
}

DetailRays::Moved DetailHits::movedOf(const DirtyGroups::Dirty& dirty) const {
    DetailRays::Moved moved;
    for (std::uint32_t object : dirty.moved) {
        moved.elements.push_back(patches_.objects[object].elements);
        if (!boxes_[object].empty()) moved.boxes.push_back(boxes_[object]);
    }
    if (!dirty.moved.empty()) moved.elements.push_back({kGone, 1});
    return moved;
}

DetailHits::Outcome DetailHits::traceNodes(std::uint32_t group) {
    Outcome outcome;
    const DirtyGroups::Dirty& dirty = dirtyNodes_[group];
    const DetailRays::Moved moved = movedOf(dirty);
    for (std::uint32_t i = 0; i < kGroup; ++i) {
        const std::uint32_t n = group * kGroup + i;
        const Receiver& node = patches_.nodes[n];
        if (isPadding(node) || !isThere(patches_.nodeBlockObject[n / PatchSet::kBlock])) continue;
        DetailRays::Hits hits;
        hits.near = nodeNear_[n];
        const auto known = std::span(nodeHits_).subspan(std::size_t(n) * kRays, kRays);
        std::copy(known.begin(), known.end(), hits.elements.begin());
        const std::uint64_t which =
            dirty.anew >> i & 1 ? DetailRays::kAllRays
                                : rays_.affected(node, DetailRays::kAllRays, known, moved, kFar);
        outcome.rays += std::uint64_t(rays_.follow(node, which, false, hits));
        outcome.ways.add(hits.ways);
        std::copy(hits.elements.begin(), hits.elements.end(), known.begin());
        nodeNear_[n] = hits.near;
        const double free = openness(hits.near, kRays);
        if (free != nodeOpenness_[n]) outcome.changed |= 1u << i;
        nodeOpenness_[n] = free;
    }
    return outcome;
}

DetailHits::Outcome DetailHits::traceVertices(std::uint32_t group) {
    Outcome outcome;
    const DirtyGroups::Dirty& dirty = dirtyVertices_[group];
    const DetailRays::Moved moved = movedOf(dirty);
    if (!dirty.judge && !anyAffected(group, moved)) return outcome;
    const Group known = std::move(groups_[group]);
    Group& out = groups_[group] = {};
    for (std::uint32_t i = 0; i < kGroup; ++i) {
        const std::uint32_t v = group * kGroup + i;
        const auto [patch, s, t] = patches_.vertexCoordinates[v];
        if (patch == Element::kNone || !isThere(patches_.vertexBlockObject[v / PatchSet::kBlock]))
            continue;
        const double expected =
            interpolateNodes<double>(patches_.patches[patch], s, t, nodeOpenness_);
        follow(
            {v, patches_.vertices[v].receiver, expected, (dirty.anew >> i & 1) != 0, known, moved},
            out, outcome);
    }
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
                    known.probes[slot], patches_.patchSize))
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
void DetailHits::follow(const Visit& at, Group& out, Outcome& outcome) const {
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
        const auto& known = at.known.probes[slot];
        std::copy(known.begin(), known.end(), hits.elements.begin());
        for (std::size_t r = 0; r < known.size(); ++r)
            hits.near |= std::uint64_t(known[r] != Element::kNone) << r;
        which = rays_.affected(at.receiver, which, known, at.moved, patches_.patchSize);
    }
    outcome.rays += std::uint64_t(rays_.follow(at.receiver, which, true, hits));
    const double guess = openness(hits.near & DetailRays::kAllProbes, kProbes);
    if (std::abs(guess - at.expected) < 0.07 && guess > 0.5) {
        // Rays that meet nothing near matter no farther.
        for (std::size_t r = 0; r < std::size_t(kProbes); ++r)
            out.probes[slot][r] = hits.near >> r & 1 ? hits.elements[r] : Element::kNone;
        out.probed |= 1u << slot;
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
                        Outcome& outcome) const {
    Gatherer gatherer;
    gatherer.vertex = at.vertex;
    gatherer.near = hits.near;
    gatherer.first = std::uint32_t(out.hits.size());
    const double open = openness(hits.near, kRays);
    gatherer.detail = float(smoothstep(0.02, 0.08, std::abs(open - at.expected)));
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
