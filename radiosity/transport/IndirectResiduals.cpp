// R = E + rho F S - S: what patches reflect, and what they owe.
#include "base/Parallel.h"
#include "radiosity/rows/SenderSamples.h"
#include "radiosity/transport/DirectLight.h"
#include "radiosity/transport/IndirectLight.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace penumbra {

namespace {

constexpr std::uint32_t kBlock = PatchSet::kBlock;
/// Mean over a patch from its middle and its four corners: Simpson's rule in two dimensions with
/// the edge points left out, exact for quadratics.
constexpr double kMiddleWeight = 2.0 / 3.0;

/// How much the nodes of a patch count for its mean, or for one of its cells: the middle, then the
/// corners. All are at least 0 and add up to 1, so that the certificate holds for cells as well.
struct NodeWeights {
    double middle = kMiddleWeight;
    std::array<double, 4> corners{(1 - kMiddleWeight) / 4, (1 - kMiddleWeight) / 4,
                                  (1 - kMiddleWeight) / 4, (1 - kMiddleWeight) / 4};
};

/// Of cells: bilinear between the corners, and the more of the middle the further inside. Over the
/// 16 cells this has the mean above.
std::array<NodeWeights, kPatchSamples> cellWeights() {
    std::array<NodeWeights, kPatchSamples> all;
    for (std::size_t k = 0; k < all.size(); ++k) {
        const glm::dvec2 st = cellMiddle(k);
        const auto isInner = [](double x) { return x > 0.25 && x < 0.75; };
        const double outer = (isInner(st.x) ? 0 : 1) + (isInner(st.y) ? 0 : 1);
        const double rest = outer / 3;
        all[k] = {1 - rest,
                  {rest * (1 - st.x) * (1 - st.y), rest * st.x * (1 - st.y), rest * st.x * st.y,
                   rest * (1 - st.x) * st.y}};
    }
    return all;
}

/// What is known at the nodes of a patch.
template <class Value>
struct AtNodes {
    template <class AtNode>
    AtNodes(const Patch& patch, const AtNode& atNode)
        : middle(atNode(patch.centreNode)), even(!patch.hasCornerNodes) {
        for (std::size_t k = 0; k < 4 && !even; ++k) corners[k] = atNode(patch.cornerNodes[k]);
    }
    Value mean(const NodeWeights& weights = {}) const {
        if (even) return middle;
        Value sum = weights.middle * middle;
        for (std::size_t k = 0; k < 4; ++k) sum += weights.corners[k] * corners[k];
        return sum;
    }
    Value middle;
    std::array<Value, 4> corners{};
    bool even; ///< all of it is like the middle
};

glm::dvec3 toDouble(Rgb c) {
    return {c.r, c.g, c.b};
}

} // namespace

/// Form factors are exact, but visibility is sampled, so that a node's factors do not add up to the
/// whole hemisphere: what is too much is taken off in proportion, which also bounds the
/// certificate. Where surfaces are all around, what is missing is added likewise, once no row is.
glm::dvec3 IndirectLight::node(std::uint32_t index) const {
    return nodes_[index] / (isWhole(index) ? rowSums_[index] : std::max(1.0, rowSums_[index]));
}

/// Whether a node's factors are to add up to 1.
bool IndirectLight::isWhole(std::uint32_t index) const {
    constexpr double kLeast = 0.5; // what is missing then is more than sampling leaves out
    return completed_ && rowSums_[index] > kLeast && reach_.isEnclosed(index);
}

glm::dvec3 IndirectLight::reflected(std::uint32_t index) const {
    if (!sends(index)) return glm::dvec3(0);
    const AtNodes<glm::dvec3> indirect(set_.patches[index],
                                       [&](std::uint32_t n) { return node(n); });
    return toDouble(patchReflectance(set_, index)) * (direct_.patches()[index] + indirect.mean());
}

/// Whether a patch is there and light gets to it. What the nodes of others still hold is deferred
/// work: it is right for these to send nothing.
bool IndirectLight::sends(std::uint32_t index) const {
    return senders_.present(index) &&
           (index >= reach_.patches.size() || reach_.patches[index] != 0);
}

/// What the cells of a patch send if nothing is owed any more [lm/m^2].
void IndirectLight::reflect(std::uint32_t index, std::span<glm::dvec3> cells) const {
    static const std::array<NodeWeights, kPatchSamples> kWeights = cellWeights();
    if (!senders_.isUneven(index) || !sends(index)) {
        std::ranges::fill(cells, reflected(index));
        return;
    }
    const Patch& patch = set_.patches[index];
    const glm::dvec3 rho = toDouble(patchReflectance(set_, index));
    const AtNodes<glm::dvec3> indirect(patch, [&](std::uint32_t n) { return node(n); });
    const auto direct = direct_.cells(index);
    for (std::size_t k = 0; k < cells.size(); ++k)
        cells[k] = rho * (toDouble(direct[k]) +
                          indirect.mean(patch.cornerCount == 4 ? kWeights[k] : NodeWeights{}));
}

/// What cells of patches reflect of the direct light. \param stale senders: 1 where it is not what
/// it was
void IndirectLight::reflectDirect(std::span<std::uint8_t> stale) {
    reflectedDirect_.resize(senders_.cellCount());
    parallelFor(senders_.patchCount(), 512, [&](std::size_t first, std::size_t last) {
        for (auto p = std::uint32_t(first); p < last; ++p) {
            std::array<glm::dvec3, kSenderCells> now{};
            const std::span<glm::dvec3> cells = cellsOf(reflectedDirect_, p);
            reflectDirect(p, std::span(now).first(cells.size()));
            if (std::ranges::equal(cells, std::span(now).first(cells.size()))) continue;
            std::copy_n(now.begin(), cells.size(), cells.begin());
            stale[p] = 1;
        }
    });
}

/// Of a patch. \param cells all 0
void IndirectLight::reflectDirect(std::uint32_t index, std::span<glm::dvec3> cells) const {
    if (!sends(index)) return;
    const glm::dvec3 rho = toDouble(patchReflectance(set_, index));
    if (!senders_.isUneven(index)) {
        std::ranges::fill(cells, rho * direct_.patches()[index]);
        return;
    }
    const auto direct = direct_.cells(index);
    for (std::size_t k = 0; k < cells.size(); ++k) cells[k] = rho * toDouble(direct[k]);
}

/// Fills in what an object's clusters send, from what their patches do.
void IndirectLight::averageClusters(ObjectId object) {
    senders_.average(object, now_);
    const Range clusters = senders_.clustersOf(object);
    for (std::uint32_t s = clusters.first; s < clusters.end(); ++s)
        std::ranges::copy(cellsOf(reflectedDirect_, s).first(kSenderCells),
                          cellsOf(now_, s).begin());
}

/// What dirty blocks may change in what arrives at any cell of a patch by other patches [lux].
double IndirectLight::dirtyOver(std::uint32_t index) const {
    const AtNodes<double> dirty(set_.patches[index], [&](std::uint32_t n) { return dirtyAt(n); });
    double most = dirty.middle;
    for (const double corner : dirty.corners) most = std::max(most, corner);
    return most;
}

/// What dirty blocks may change in the light at a node [lux]: what arrives, and the row sum f by
/// which it is divided, as far as that is or comes to be above 1.
double IndirectLight::dirtyAt(std::uint32_t index) const {
    const DirtySet& dirty = updates_.dirty();
    const double f = dirty.factor(index / kBlock);
    if (f == 0 || !reached(index)) return 0;
    const double above = isWhole(index) ? f : std::max(0.0, rowSums_[index] + f - 1);
    return dirty.light(index / kBlock) + std::min(f, above) * largest(node(index));
}

/// Of what has been noted. Batches that have not begun are chosen again.
void IndirectLight::residualsChanged() {
    residualsStale_ = true;
    changedBlocks_.resize(blockCount());
    listing_.reset();
}

void IndirectLight::allChanged() {
    allStale_ = true;
    residualsChanged();
}

/// A batch changes what it served and nothing else.
void IndirectLight::noteBatch(const Shot& shot) {
    residualsChanged();
    for (std::size_t b = 0; b < shot.receivers.size(); ++b)
        if (!shot.receivers[b].empty()) changedBlocks_[b] = 1;
    changedSenders_.insert(changedSenders_.end(), shot.senders.begin(), shot.senders.end());
}

/// Patches that are there, or send from where they are, as they did not before.
void IndirectLight::noteSenders(const SceneChange& change) {
    const auto note = [&](std::uint32_t p) { changedSenders_.push_back(p); };
    for (const ObjectId object : change.objects) {
        const Range own = set_.objects[object.value].patches;
        for (std::uint32_t p = own.first; p < own.end(); ++p) set_.forEachPart(p, note), note(p);
    }
    for (const std::uint32_t p : change.senders) note(p);
    for (const std::uint32_t p : change.parted) set_.forEachPart(p, note), note(p);
}

/// Nodes and patches that light gets to as it did not before, or not any more.
void IndirectLight::noteReached(const Reach& now) {
    if (now == reach_) return;
    residualsChanged();
    for (std::size_t b = 0; b < now.nodes.size(); ++b)
        changedBlocks_[b] |=
            now.nodes[b] != reach_.nodes[b] || now.enclosed[b] != reach_.enclosed[b];
    if (now.patches.size() != reach_.patches.size()) return allChanged();
    for (std::uint32_t p = 0; p < now.patches.size(); ++p)
        if (now.patches[p] != reach_.patches[p]) changedSenders_.push_back(p);
}

void IndirectLight::PatchBound::Sums::add(const Sums& other) {
    area += other.area;
    reflectingArea += other.reflectingArea;
    radiosity += other.radiosity;
    owed += other.owed;
    reflected += other.reflected;
}

void IndirectLight::PatchBound::add(const PatchBound& other) {
    dirtyDirect = std::max(dirtyDirect, other.dirtyDirect);
    dirty = std::max(dirty, other.dirty);
    both = std::max(both, other.both);
    for (std::size_t k = 0; k < sums.size(); ++k) sums[k].add(other.sums[k]);
}

/// Senders (1) whose residuals are not what they were.
std::vector<std::uint8_t> IndirectLight::staleSenders(bool all,
                                                      std::span<const double> dirtyDirect) {
    std::vector<std::uint8_t> stale(senders_.count(), std::uint8_t(all));
    std::vector<std::uint8_t> blocks = std::exchange(changedBlocks_, {});
    const std::vector<std::uint32_t> changed = std::exchange(changedSenders_, {});
    blocks.resize(blockCount());
    dirtyBlocks_.resize(blocks.size());
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        const DirtySet& dirty = updates_.dirty();
        const std::pair now(double(dirty.light(b)), double(dirty.factor(b)));
        if (std::exchange(dirtyBlocks_[b], now) != now) blocks[b] = 1;
    }
    if (all) return stale;
    for (std::uint32_t p = 0; p < senders_.patchCount(); ++p) {
        if (!senders_.present(p)) continue; // it owes what it sent
        const Patch& patch = set_.patches[p];
        bool differs = dirtyDirect[p] != dirtyDirect_[p] || blocks[patch.centreNode / kBlock] != 0;
        for (std::size_t k = 0; k < 4 && patch.hasCornerNodes && !differs; ++k)
            differs = blocks[patch.cornerNodes[k] / kBlock] != 0;
        stale[p] = differs;
    }
    for (const std::uint32_t s : changed) stale[s] = 1;
    return stale;
}

void IndirectLight::updateResiduals() {
    residualsStale_ = false;
    std::vector<double> dirtyDirect = direct_.dirtyLight();
    const bool all = std::exchange(allStale_, false) || now_.size() != senders_.cellCount() ||
                     dirtyDirect_.size() != dirtyDirect.size();
    std::vector<std::uint8_t> stale = staleSenders(all, dirtyDirect);
    const bool direct = std::exchange(directStale_, false);
    if (direct) reflectDirect(stale);
    dirtyDirect_ = std::move(dirtyDirect);
    now_.resize(senders_.cellCount()), residuals_.resize(senders_.cellCount());
    patchBounds_.resize(senders_.patchCount()), owed_.resize(senders_.count());
    parallelFor(senders_.patchCount(), 512, [&](std::size_t first, std::size_t last) {
        for (auto p = std::uint32_t(first); p < last; ++p)
            if (stale[p] != 0) updatePatch(p);
    });
    std::vector<std::uint8_t> ofObject(set_.objects.size());
    for (std::uint32_t p = 0; p < senders_.patchCount(); ++p)
        ofObject[senders_.object(p).value] |= stale[p];
    parallelFor(ofObject.size(), 1, [&](std::size_t first, std::size_t last) {
        for (auto o = std::uint32_t(first); o < last; ++o) {
            if (ofObject[o] == 0) continue;
            if (direct) senders_.deviate({o}, reflectedDirect_);
            averageClusters({o});
            const Range clusters = senders_.clustersOf({o});
            std::fill_n(stale.begin() + clusters.first, clusters.count, std::uint8_t(1));
        }
    });
    parallelFor(senders_.count(), 512, [&](std::size_t first, std::size_t last) {
        for (auto s = std::uint32_t(first); s < last; ++s) {
            if (stale[s] == 0) continue;
            const SenderLight now = cellsOf(std::as_const(now_), s),
                              sent = cellsOf(std::as_const(sent_), s);
            const std::span<glm::dvec3> owed = cellsOf(residuals_, s);
            for (std::size_t c = 0; c < owed.size(); ++c) owed[c] = now[c] - sent[c];
            const SenderLight cells = owed;
            owed_[s].most = largest(cells);
            owed_[s].toAny =
                cells.size() == kClusterCells
                    ? largest(cells.first(kSenderCells)) + largest(cells.subspan(kSenderCells))
                    : owed_[s].most;
            if (s < senders_.patchCount()) sumPatch(s);
        }
    });
    bound(stale);
}

/// What a patch sends if nothing is owed any more, and what it may still be wrong by.
void IndirectLight::updatePatch(std::uint32_t index) {
    const std::span<glm::dvec3> cells = cellsOf(now_, index);
    const SenderLight sent = cellsOf(std::as_const(sent_), index);
    PatchBound& bound = patchBounds_[index] = {};
    if (!senders_.present(index)) { // it has yet to take back what it sent
        std::ranges::fill(cells, glm::dvec3(0));
        bound.both = largest(sent);
        return;
    }
    reflect(index, cells);
    const double rho = maxChannel(patchReflectance(set_, index));
    // A cell's direct light is an element's, plus the patch's mean, minus the cells' own.
    bound.dirtyDirect = (senders_.isUneven(index) ? 3 : 1) * rho * dirtyDirect_[index];
    bound.dirty = bound.dirtyDirect + rho * dirtyOver(index);
    for (std::size_t c = 0; c < cells.size(); ++c)
        bound.both = std::max(bound.both, largest(cells[c] - sent[c]) + bound.dirty);
    if (rho <= 0) return;
    const Patch& patch = set_.patches[index];
    bound.sums[patch.far].reflectingArea = patch.area;
    bound.sums[patch.far].radiosity = patch.area * largest(meanOf(cells));
}

/// Adds what the ambient term is made of. \pre its residual is known
void IndirectLight::sumPatch(std::uint32_t index) {
    if (!set_.parts.used.empty() && !set_.parts.used[index]) return;
    const Patch& patch = set_.patches[index];
    PatchBound::Sums& sums = patchBounds_[index].sums[patch.far];
    sums.area = patch.area;
    sums.owed = double(patch.area) * meanOf(cellsOf(std::as_const(residuals_), index));
    sums.reflected = double(patch.area) * toDouble(patchReflectance(set_, index));
}

/// What all of the light may still be wrong by. \param stale senders (1) that are not what they
/// were
void IndirectLight::bound(std::span<const std::uint8_t> stale) {
    constexpr std::size_t kBoundGroup = 64; // patches that are added up first
    groupBounds_.resize((patchBounds_.size() + kBoundGroup - 1) / kBoundGroup);
    bounds_ = {};
    for (std::size_t g = 0; g < groupBounds_.size(); ++g) {
        const std::size_t first = g * kBoundGroup;
        const std::size_t count = std::min(kBoundGroup, patchBounds_.size() - first);
        if (std::ranges::find(stale.subspan(first, count), 1) != stale.begin() + first + count) {
            groupBounds_[g] = {};
            for (std::size_t i = 0; i < count; ++i) groupBounds_[g].add(patchBounds_[first + i]);
        }
        bounds_.add(groupBounds_[g]);
    }
    most_ = 0;
    for (const Owed& owed : owed_) most_ = std::max(most_, owed.most);
    // What a cluster sends is a quarter's mean, plus a cell's direct light, minus that quarter's.
    double both = bounds_.both;
    for (std::uint32_t s = senders_.patchCount(); s < senders_.count(); ++s)
        both = std::max(both, owed_[s].toAny + bounds_.dirty + 4.0 / 3 * bounds_.dirtyDirect);
    dirtyBound_ = bounds_.dirty;
    certificate_ = both > 0 ? gain_ * both : 0;
    const auto& [near, far] = bounds_.sums;
    const PatchBound::Sums& seen = near.radiosity > 0 ? near : far;
    meanRadiosity_ = seen.reflectingArea > 0 ? seen.radiosity / seen.reflectingArea : 0;
}

/// Reflectances, and what follows from them. |B_exact - B| <= max|R| / (1 - max(rho * row sum)), in
/// the maximum norm; row sums are at most 1. Means over clusters differ from the exact ones by no
/// more than what they are the means of.
void IndirectLight::coloursChanged() {
    directStale_ = true;
    float most = 0;
    colours_.assign(senders_.cellCount(), glm::dvec3(0));
    reflectances_.assign(blockCount(), 0.0f);
    for (std::uint32_t p = 0; p < set_.patches.size(); ++p) {
        const Patch& patch = set_.patches[p];
        const bool there = set_.parts.used.empty() || set_.parts.used[p];
        const Rgb colour = there ? patchReflectance(set_, p) : Rgb();
        const float rho = maxChannel(colour);
        std::ranges::fill(cellsOf(colours_, p), toDouble(colour));
        if (!there) continue;
        most = std::max(most, rho);
        const auto at = [&](std::uint32_t n) {
            reflectances_[n / kBlock] = std::max(reflectances_[n / kBlock], rho);
        };
        at(patch.centreNode);
        if (patch.hasCornerNodes) std::for_each_n(patch.cornerNodes.begin(), 4, at);
    }
    senders_.average(colours_);
    gain_ = 1 / (1 - double(most));
}

/// What is owed goes, on average, once over all surfaces and is reflected on: Cohen et al. 1988.
/// What a ground of hundreds of metres owes is not for the room that stands on it.
glm::dvec3 IndirectLight::ambient() const {
    const auto& [near, far] = bounds_.sums;
    const PatchBound::Sums& sums = near.area > 0 ? near : far;
    if (sums.area == 0) return glm::dvec3(0);
    return (sums.owed / sums.area) / (1.0 - glm::min(sums.reflected / sums.area, 0.98));
}

std::vector<glm::dvec3> IndirectLight::nodes() const {
    const glm::dvec3 owed = ambient();
    std::vector<glm::dvec3> values(nodes_.size());
    for (std::uint32_t n = 0; n < values.size(); ++n)
        values[n] = node(n) + (reached(n) ? owed : glm::dvec3(0));
    return values;
}

} // namespace penumbra
