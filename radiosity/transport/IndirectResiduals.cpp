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

/// Bound of what a sender owes to any receiver [lm/m^2].
double IndirectLight::owed(std::uint32_t sender) const {
    const SenderLight cells = cellsOf(residuals_, sender);
    if (cells.size() != kClusterCells) return largest(cells);
    return largest(cells.first(kSenderCells)) + largest(cells.subspan(kSenderCells));
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

/// What cells reflect of the direct light; of clusters, by how much that differs in place.
void IndirectLight::reflectDirect() {
    reflectedDirect_.assign(senders_.cellCount(), glm::dvec3(0));
    parallelFor(senders_.patchCount(), 512, [&](std::size_t first, std::size_t last) {
        for (auto p = std::uint32_t(first); p < last; ++p)
            reflectDirect(p, cellsOf(reflectedDirect_, p));
    });
    senders_.deviate(reflectedDirect_);
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

/// Fills in what clusters send, from what their patches do.
void IndirectLight::averageClusters(std::vector<glm::dvec3>& cells) const {
    senders_.average(cells);
    for (std::uint32_t s = senders_.patchCount(); s < senders_.count(); ++s)
        std::ranges::copy(cellsOf(reflectedDirect_, s).first(kSenderCells),
                          cellsOf(cells, s).begin());
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

/// Batches that have not begun are chosen again.
void IndirectLight::residualsChanged() {
    residualsStale_ = true;
    listing_.reset();
}

namespace {

/// Bounds of what some patches owe, and what they send.
struct Part {
    double dirtyDirect = 0, dirty = 0, both = 0, area = 0, radiosity = 0;

    void add(const Part& other) {
        dirtyDirect = std::max(dirtyDirect, other.dirtyDirect);
        dirty = std::max(dirty, other.dirty);
        both = std::max(both, other.both);
        area += other.area;
        radiosity += other.radiosity;
    }
};

} // namespace

void IndirectLight::updateResiduals() {
    residualsStale_ = false;
    constexpr std::size_t kGrain = 512;
    std::vector<Part> parts((senders_.patchCount() + kGrain - 1) / kGrain);
    const std::vector<double> dirtyDirect = direct_.dirtyLight();
    if (std::exchange(directStale_, false)) reflectDirect();
    std::vector<glm::dvec3> now(senders_.cellCount());
    parallelFor(senders_.patchCount(), kGrain, [&](std::size_t first, std::size_t last) {
        Part& part = parts[first / kGrain];
        for (auto p = std::uint32_t(first); p < last; ++p) {
            const Patch& patch = set_.patches[p];
            const SenderLight sent = cellsOf(sent_, p);
            if (!senders_.present(p)) { // it has yet to take back what it sent
                part.both = std::max(part.both, largest(sent));
                continue;
            }
            const std::span<glm::dvec3> cells = cellsOf(now, p);
            reflect(p, cells);
            const double rho = maxChannel(patchReflectance(set_, p));
            // A cell's direct light is an element's, plus the patch's mean, minus the cells' own.
            const double dirtyHere = (senders_.isUneven(p) ? 3 : 1) * rho * dirtyDirect[p];
            const double dirty = dirtyHere + rho * dirtyOver(p);
            part.dirtyDirect = std::max(part.dirtyDirect, dirtyHere);
            part.dirty = std::max(part.dirty, dirty);
            for (std::size_t c = 0; c < cells.size(); ++c)
                part.both = std::max(part.both, largest(cells[c] - sent[c]) + dirty);
            if (rho <= 0) continue;
            part.area += patch.area;
            part.radiosity += patch.area * largest(meanOf(cells));
        }
    });
    Part all;
    for (const Part& part : parts) all.add(part);
    averageClusters(now);
    for (std::size_t c = 0; c < now.size(); ++c) now[c] -= sent_[c];
    residuals_ = std::move(now);
    most_ = largest(residuals_);
    // What a cluster sends is a quarter's mean, plus a cell's direct light, minus that quarter's.
    for (std::uint32_t s = senders_.patchCount(); s < senders_.count(); ++s)
        all.both = std::max(all.both, owed(s) + all.dirty + 4.0 / 3 * all.dirtyDirect);
    dirtyBound_ = all.dirty;
    certificate_ = all.both > 0 ? gain_ * all.both : 0;
    meanRadiosity_ = all.area > 0 ? all.radiosity / all.area : 0;
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
glm::dvec3 IndirectLight::ambient() const {
    glm::dvec3 owed(0), reflected(0);
    double area = 0;
    for (std::uint32_t p = 0; p < set_.patches.size(); ++p) {
        const double size =
            set_.parts.used.empty() || set_.parts.used[p] ? set_.patches[p].area : 0;
        owed += size * meanOf(cellsOf(residuals_, p));
        reflected += size * toDouble(patchReflectance(set_, p));
        area += size;
    }
    if (area == 0) return owed;
    return (owed / area) / (1.0 - glm::min(reflected / area, 0.98));
}

std::vector<glm::dvec3> IndirectLight::nodes() const {
    const glm::dvec3 owed = ambient();
    std::vector<glm::dvec3> values(nodes_.size());
    for (std::uint32_t n = 0; n < values.size(); ++n)
        values[n] = node(n) + (reached(n) ? owed : glm::dvec3(0));
    return values;
}

} // namespace penumbra
