#include "radiosity/transport/DetailGather.h"

#include "base/Parallel.h"
#include "base/Wide.h"
#include "radiosity/mesh/Interpolation.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <unordered_map>
#include <utility>

namespace penumbra {

namespace {

constexpr int kRays = DetailHits::kRays;
constexpr float kMostOfFar = 5;   ///< of what a vertex receives: what a far ray counts for
constexpr float kAlike = 0.9998f; ///< cosine: one degree
constexpr int kSweeps = 10;       ///< light goes from gathering vertex to gathering vertex
/// So many take all that gathers; from then on what changed by less than this share, of what is
/// drawn of it, in the last one that took it is left as it is. Most is, and light in a few deep
/// slits needs many sweeps.
constexpr int kFullSweeps = 3;
constexpr double kSettled = 1e-3;
constexpr int kRounds = 3; ///< of a sweep

/// Mean direct illuminance of an element's corners [lux].
Rgb directMean(const Element& element, std::span<const Rgb> direct) {
    const std::size_t count = element.isTriangle() ? 3 : 4;
    Rgb sum;
    for (std::size_t k = 0; k < count; ++k) sum += direct[element.vertices[k]];
    return (1.0f / float(count)) * sum;
}

Rgb toRgb(glm::dvec3 v) {
    return {float(v.x), float(v.y), float(v.z)};
}

/// What sweeps without end would add to a last step: they are a geometric series where light goes
/// to and fro in a slit, and no more of it comes back than a surface reflects.
/// \param before the luminance of the step before
Rgb stillToCome(Rgb step, float before, Rgb reflectance) {
    constexpr float kMostRatio = 0.95f;
    const float now = luminance(step);
    if (!(now > 0) || !(before > 0)) return {};
    const float ratio = std::min({now / before, luminance(reflectance), kMostRatio});
    return ratio / (1 - ratio) * step;
}

/// \param drawn what `now` is part of [lux]
bool isSettled(Rgb was, Rgb now, Rgb drawn) {
    return double(maxChannel(absolute(now - was))) < kSettled * double(maxChannel(drawn));
}

} // namespace

/// Sweeps under way. Each takes kRounds, of blended vertices, elements, and vertices that gather;
/// of the last one's vertices only those are gathered that are asked for.
struct DetailGather::Sweep {
    std::span<const Rgb> direct;
    std::vector<Rgb> indirect;
    std::vector<glm::dvec3> nodeIndirect;
    Sent sent;
    std::vector<float> steps;          ///< of all luminance sent, in the last sweep but one
    std::vector<std::uint8_t> settled; ///< vertices; 1: see kFullSweeps
    int round = -1; ///< -1: vertices are interpolated; kRounds i + k: round k of sweep i
    std::size_t next = 0;

    int index() const { return round / kRounds; } ///< of the sweep
    bool isFull() const { return index() < kFullSweeps; }
};

DetailGather::DetailGather(const PatchSet& patches, NodeHits& nodes)
    : patches_(patches), hits_(patches, nodes) {}

DetailGather::~DetailGather() = default;

/// The mean.
DetailGather::Light DetailGather::usual(const std::vector<Light>& lights) {
    glm::dvec3 sum(0);
    for (const Light& light : lights)
        sum += glm::dvec3(light.colour.r, light.colour.g, light.colour.b);
    const Rgb mean = toRgb(sum / double(std::max<std::size_t>(lights.size(), 1)));
    return {mean, luminance(mean)};
}

/// Of what is new nothing is known but what is usual. Sweeps under way know nothing of it: they
/// begin again, though it may be hidden and no edit follow.
void DetailGather::add(std::span<const ObjectId> objects) {
    hits_.add(objects);
    sweeping_ = false;
    if (sent_.all.empty()) return;
    sent_.all.resize(patches_.elements.size(), usual(sent_.all));
    sent_.direct.resize(patches_.elements.size(), usual(sent_.direct));
}

/// Likewise.
void DetailGather::takeOver(const DetailGather& before, const PatchMatch& match,
                            const NodeHits::Taken& taken) {
    if (!hits_.takeOver(before.hits_, match, taken) || before.sent_.all.empty()) return;
    const std::vector<std::uint32_t>& elements = taken.elements;
    std::vector<std::uint32_t> were(patches_.elements.size(), PatchMatch::kNew);
    for (std::uint32_t e = 0; e < elements.size(); ++e)
        if (elements[e] != DetailHits::kGone) were[elements[e]] = e;
    const auto take = [](const auto& from, std::span<const std::uint32_t> numbers, auto usual,
                         auto& to) {
        to.assign(numbers.size(), usual);
        for (std::size_t i = 0; i < numbers.size(); ++i)
            if (numbers[i] != PatchMatch::kNew) to[i] = from[numbers[i]];
    };
    take(before.sent_.all, were, usual(before.sent_.all), sent_.all);
    take(before.sent_.direct, were, usual(before.sent_.direct), sent_.direct);
}

void DetailGather::apply(const SceneChange& change, std::span<const NodeHits::Move> moves) {
    hits_.apply(change, moves);
    swept_ = sweeping_ = false;
    pending_ = true;
}

void DetailGather::invalidate(const Bounds& region) {
    hits_.invalidate(region);
    swept_ = sweeping_ = false;
    pending_ = true;
}

void DetailGather::beginSweeps(std::span<const Rgb> direct, std::vector<glm::dvec3> nodeIndirect) {
    assert(hits_.done());
    sweep_ = std::make_unique<Sweep>();
    sweep_->direct = direct;
    sweep_->indirect.resize(direct.size());
    sweep_->nodeIndirect = std::move(nodeIndirect);
    sweep_->sent.all.resize(patches_.elements.size());
    sweep_->sent.direct.resize(patches_.elements.size());
    sweep_->steps.assign(patches_.elements.size(), 0);
    sweep_->settled.assign(direct.size(), 0);
    sweeping_ = true;
}

double DetailGather::share() const {
    constexpr double kTracing = 0.8; // share of the time, if all is to be traced
    if (swept_) return 1;
    const double swept = sweeping_ ? double(1 + sweep_->round) / (1 + kRounds * kSweeps) : 0;
    return kTracing * hits_.share() + (1 - kTracing) * swept;
}

void DetailGather::sweep(std::size_t effort) {
    struct Round {
        void (DetailGather::*work)(Sweep&, std::size_t, std::size_t) const;
        std::size_t count;
        std::size_t cost; ///< of sixteen of them, about [rays]
    };
    constexpr std::size_t kGroups = PatchSet::kBlock / DetailHits::kGroup; // of a block
    const std::array<Round, 1 + kRounds> rounds{{
        {&DetailGather::interpolateVertices, hits_.groupCount(), 16},
        {&DetailGather::blendVertices, hits_.groupCount() / kGroups, 16},
        {&DetailGather::sendElements, patches_.elements.size(), 2},
        {&DetailGather::gatherVertices, hits_.groupCount(), 512},
    }};
    Sweep& s = *sweep_;
    const Round& round = rounds[std::size_t(s.round < 0 ? 0 : 1 + s.round % kRounds)];
    const std::size_t count =
        std::min(round.count - s.next, std::max<std::size_t>(16, 16 * effort / round.cost));
    parallelFor(count, std::max<std::size_t>(16, 4096 / round.cost),
                [&](std::size_t first, std::size_t last) {
                    (this->*round.work)(s, s.next + first, s.next + last);
                });
    s.next += count;
    if (s.next < round.count) return;
    s.next = 0;
    if (++s.round < kRounds * kSweeps - 1) return;
    sent_ = std::move(s.sent);
    sweep_.reset();
    sweeping_ = pending_ = false;
    swept_ = true;
}

/// From below: what near surfaces add comes with the sweeps.
void DetailGather::interpolateVertices(Sweep& sweep, std::size_t first, std::size_t last) const {
    constexpr std::size_t kGroup = DetailHits::kGroup;
    for (std::size_t group = first; group < last; ++group) {
        for (std::size_t v = group * kGroup; v < (group + 1) * kGroup; ++v) {
            const PatchCoordinate& at = patches_.vertexCoordinates[v];
            sweep.indirect[v] = Rgb();
            if (at.patch == Element::kNone) continue;
            sweep.indirect[v] =
                toRgb(interpolateNodes<glm::dvec3>(patches_, at, sweep.nodeIndirect));
        }
        for (const auto& gatherer : hits_.gatherers(group))
            if (gatherer.weighs()) sweep.indirect[gatherer.vertex] *= 1 - gatherer.shut;
    }
}

/// Has the vertices of a blended block take what rays found at the receivers around them.
/// \param indirect     interpolated as yet [lux]
/// \param correctionOf by how much that is not what was interpolated at a receiver [lux]
template <class CorrectionOf>
void DetailGather::blend(std::uint32_t block, std::span<Rgb> indirect,
                         const CorrectionOf& correctionOf) const {
    for (std::uint32_t v = block * PatchSet::kBlock; v < (block + 1) * PatchSet::kBlock; ++v) {
        if (patches_.vertexCoordinates[v].patch == Element::kNone) continue;
        Rgb correction;
        patches_.forEachReceiver(v, [&](std::uint32_t receiver, float weight) {
            const DetailHits::Gatherer* const gatherer = hits_.gatherer(receiver);
            if (gatherer && gatherer->weighs()) correction += weight * correctionOf(*gatherer);
        });
        const Rgb light = indirect[v] + correction;
        indirect[v] = {std::max(light.r, 0.0f), std::max(light.g, 0.0f), std::max(light.b, 0.0f)};
    }
}

void DetailGather::blendVertices(Sweep& sweep, std::size_t first, std::size_t last) const {
    const auto interpolated = [&](std::uint32_t v) {
        return toRgb(interpolateNodes<glm::dvec3>(patches_, patches_.vertexCoordinates[v],
                                                  sweep.nodeIndirect));
    };
    for (auto block = std::uint32_t(first); block < last; ++block) {
        if (!patches_.isBlended(block)) continue;
        for (std::uint32_t v = block * PatchSet::kBlock; v < (block + 1) * PatchSet::kBlock; ++v)
            if (patches_.vertexCoordinates[v].patch != Element::kNone)
                sweep.indirect[v] = interpolated(v);
        blend(block, sweep.indirect, [&](const DetailHits::Gatherer& gatherer) {
            return sweep.indirect[gatherer.vertex] - interpolated(gatherer.vertex);
        });
    }
}

void DetailGather::sendElements(Sweep& sweep, std::size_t first, std::size_t last) const {
    for (std::size_t e = first; e < last; ++e) {
        const Element& element = patches_.elements[e];
        const Rgb rho = elementReflectance(patches_, std::uint32_t(e));
        Rgb all = rho * elementMean(element, sweep.direct, sweep.indirect);
        const Rgb direct = rho * directMean(element, sweep.direct);
        const Rgb step = all - sweep.sent.all[e].colour;
        if (sweep.index() == kSweeps - 2) sweep.steps[e] = luminance(step);
        if (sweep.index() == kSweeps - 1) all += stillToCome(step, sweep.steps[e], rho);
        sweep.sent.all[e] = {all, luminance(all)};
        sweep.sent.direct[e] = {direct, luminance(direct)};
    }
}

void DetailGather::gatherVertices(Sweep& sweep, std::size_t first, std::size_t last) const {
    for (std::size_t group = first; group < last; ++group)
        for (const auto& gatherer : hits_.gatherers(group)) {
            const std::uint32_t v = gatherer.vertex;
            if (!gatherer.weighs() || (!sweep.isFull() && sweep.settled[v] != 0)) continue;
            const Rgb was = std::exchange(
                sweep.indirect[v], received(sweep.sent, group, gatherer, sweep.nodeIndirect));
            sweep.settled[v] =
                isSettled(was, sweep.indirect[v], sweep.direct[v] + sweep.indirect[v]);
        }
}

glm::dvec3 DetailGather::gathered(const Sent& sent, std::span<const std::uint32_t> hits, bool slit,
                                  const Bound& bound) const {
    Double4 sum{}; // red, green, blue, luminance
    glm::dvec3 returned(0);
    Light brightest;
    bool brightestCounts = false;
    float second = 0; // brightest [lm/m^2]
    for (std::size_t i = 0; i < hits.size(); ++i) {
        const bool counts = bound.which >> i & 1;
        const std::uint32_t element = hits[i] & ~DetailRays::kAcross;
        // None, or it is not known as yet what the ray meets now.
        if (element >= sent.all.size()) continue;
        const bool returns = slit && isAcross(hits[i]);
        if (returns) {
            const Rgb rho = elementReflectance(patches_, element);
            returned += glm::dvec3(rho.r, rho.g, rho.b);
        }
        Light light = returns ? sent.direct[element] : sent.all[element];
        if (light.luminance > bound.most && (bound.far >> i & 1))
            light = {bound.most / light.luminance * light.colour, bound.most};
        if (counts) sum += __builtin_convertvector(std::bit_cast<Float4>(light), Double4);
        if (light.luminance > brightest.luminance)
            second = brightest.luminance, brightest = light, brightestCounts = counts;
        else
            second = std::max(second, light.luminance);
    }
    // A single ray that finds the glowing inside of a lampshade counts like the next: no fireflies.
    // It is dimmed, not replaced, or which of two alike is the brighter would decide on the colour.
    const float more = brightestCounts ? brightest.luminance - second : 0.0f;
    const Rgb excess = more > 0 ? more / brightest.luminance * brightest.colour : Rgb();
    return (glm::dvec3(sum[0], sum[1], sum[2]) - glm::dvec3(excess.r, excess.g, excess.b)) /
           (double(kRays) - returned);
}

/// How much more a vertex gathers than its nodes do. Where it faces as a node does, rays that meet
/// nothing near from here nor there do not count: they would tell what patches know better, with
/// all the noise of few rays. For the same reason far light counts only up to a few times what is
/// `known` of the vertex: a single ray that happens to find something small and bright would stand
/// for a 64th of the hemisphere at one of them, and for nothing at the others.
glm::dvec3 DetailGather::difference(const Sent& sent, std::span<const std::uint32_t> hits,
                                    const DetailHits::Gatherer& gatherer, glm::dvec3 known) const {
    const glm::vec3 normal = patches_.vertices[gatherer.vertex].receiver.normal;
    const float most = kMostOfFar * luminance(toRgb(glm::max(known, 0.0)));
    const auto moreThan = [&](std::uint32_t node) {
        const std::uint64_t near = hits_.nodes().near(node);
        const bool alike = glm::dot(normal, patches_.nodes[node].normal) > kAlike;
        const std::uint64_t which = alike ? gatherer.near | near : ~std::uint64_t(0);
        return gathered(sent, hits, false, {which, ~gatherer.near, most}) -
               gathered(sent, hits_.nodes().hits(node), false, {which, ~near, most});
    };
    return interpolate<glm::dvec3>(patches_, patches_.vertexCoordinates[gatherer.vertex], moreThan);
}

/// Indirect light of a vertex in question [lux].
Rgb DetailGather::received(const Sent& sent, std::size_t group,
                           const DetailHits::Gatherer& gatherer,
                           std::span<const glm::dvec3> nodeIndirect) const {
    const PatchCoordinate& at = patches_.vertexCoordinates[gatherer.vertex];
    const auto hits = hits_.hits(group, gatherer);
    glm::dvec3 light(0);
    if (gatherer.shut < 1) {
        light = interpolateNodes<glm::dvec3>(patches_, at, nodeIndirect);
        if (gatherer.detail > 0)
            light += double(gatherer.detail) * difference(sent, hits, gatherer, light);
    }
    if (gatherer.shut > 0)
        light = glm::mix(light, gathered(sent, hits, gatherer.slit && inSlit(hits), {}),
                         double(gatherer.shut));
    return toRgb(glm::max(light, 0.0));
}

void DetailGather::correct(std::uint32_t block, std::span<const glm::dvec3> nodeIndirect,
                           std::span<Rgb> indirect) const {
    if (sent_.all.empty()) return;
    if (patches_.isBlended(block)) {
        std::unordered_map<std::uint32_t, Rgb> corrections;
        return blend(block, indirect, [&](const DetailHits::Gatherer& gatherer) {
            const auto [known, fresh] = corrections.try_emplace(gatherer.vertex);
            if (fresh)
                known->second =
                    received(sent_, gatherer.vertex / DetailHits::kGroup, gatherer, nodeIndirect) -
                    toRgb(interpolateNodes<glm::dvec3>(
                        patches_, patches_.vertexCoordinates[gatherer.vertex], nodeIndirect));
            return known->second;
        });
    }
    constexpr std::size_t kGroups = PatchSet::kBlock / DetailHits::kGroup;
    for (std::size_t group = block * kGroups; group < (block + 1) * kGroups; ++group)
        for (const auto& gatherer : hits_.gatherers(group)) // one that was given back may be there
            if (gatherer.weighs() &&
                patches_.vertexCoordinates[gatherer.vertex].patch != Element::kNone)
                indirect[gatherer.vertex] = received(sent_, group, gatherer, nodeIndirect);
}

} // namespace penumbra
