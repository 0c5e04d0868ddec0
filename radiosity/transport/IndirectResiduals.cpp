// R = E + rho F S - S: what patches reflect, and what they owe.
#include "base/Parallel.h"
#include "radiosity/transport/DirectLight.h"
#include "radiosity/transport/IndirectLight.h"

#include <algorithm>
#include <cmath>

namespace penumbra {

namespace {

constexpr std::uint32_t kBlock = PatchSet::kBlock;
/// Mean over a patch from its middle and its four corners: Simpson's rule in two dimensions with
/// the edge points left out, exact for quadratics.
constexpr double kMiddleWeight = 2.0 / 3.0;

glm::dvec3 toDouble(Rgb c) {
    return {c.r, c.g, c.b};
}

} // namespace

/// Form factors are exact, but visibility is sampled, so that a node's factors may add up to a
/// little more than the whole hemisphere: what is too much is taken off in proportion. This also
/// bounds the certificate.
glm::dvec3 IndirectLight::node(std::uint32_t index) const {
    return nodes_[index] / std::max(1.0, rowSums_[index]);
}

/// Over a patch, of a quantity that is known at its nodes.
template <class Value, class AtNode>
Value IndirectLight::mean(const Patch& patch, AtNode atNode) const {
    const Value middle = atNode(patch.centreNode);
    if (!patch.hasCornerNodes) return middle;
    Value corners(0);
    for (std::uint32_t n : patch.cornerNodes) corners += atNode(n);
    return kMiddleWeight * middle + (1 - kMiddleWeight) / 4 * corners;
}

glm::dvec3 IndirectLight::reflected(std::uint32_t index) const {
    const Patch& patch = set_.patches[index];
    if (!senders_.present(index)) return glm::dvec3(0);
    // What its nodes still hold then is deferred work: it is right for it to send nothing.
    if (index < reach_.patches.size() && !reach_.patches[index]) return glm::dvec3(0);
    const auto indirect = mean<glm::dvec3>(patch, [&](std::uint32_t n) { return node(n); });
    return toDouble(patchReflectance(set_, index)) * (direct_.patches()[index] + indirect);
}

/// What dirty blocks may change in the light at a node [lux]: what arrives, and the row sum f by
/// which it is divided, as far as that is or comes to be above 1.
double IndirectLight::dirtyAt(std::uint32_t index) const {
    const DirtySet& dirty = updates_.dirty();
    const double f = dirty.factor(index / kBlock);
    if (f == 0 || !reached(index)) return 0;
    const double above = std::max(0.0, rowSums_[index] + f - 1);
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
    double dirty = 0, both = 0, area = 0, radiosity = 0;

    void add(const Part& other) {
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
    std::vector<glm::dvec3> reflects(senders_.patchCount());
    parallelFor(senders_.patchCount(), kGrain, [&](std::size_t first, std::size_t last) {
        Part& part = parts[first / kGrain];
        for (auto p = std::uint32_t(first); p < last; ++p) {
            const Patch& patch = set_.patches[p];
            if (!senders_.present(p)) { // it has yet to take back what it sent
                part.both = std::max(part.both, largest(sent_[p][0]));
                continue;
            }
            const double rho = maxChannel(patchReflectance(set_, p));
            reflects[p] = reflected(p);
            const double dirty =
                rho *
                (dirtyDirect[p] + mean<double>(patch, [&](std::uint32_t n) { return dirtyAt(n); }));
            part.dirty = std::max(part.dirty, dirty);
            part.both = std::max(part.both, largest(reflects[p] - sent_[p][0]) + dirty);
            if (rho <= 0) continue;
            part.area += patch.area;
            part.radiosity += patch.area * largest(reflects[p]);
        }
    });
    Part all;
    for (const Part& part : parts) all.add(part);
    const std::vector<SenderLight> now = senders_.average(reflects);
    most_ = 0;
    for (std::uint32_t s = 0; s < senders_.count(); ++s) {
        for (std::size_t q = 0; q < 4; ++q) residuals_[s][q] = now[s][q] - sent_[s][q];
        most_ = std::max(most_, largest(residuals_[s]));
        if (s >= senders_.patchCount())
            all.both = std::max(all.both, largest(residuals_[s]) + all.dirty);
    }
    dirtyBound_ = all.dirty;
    certificate_ = all.both > 0 ? gain_ * all.both : 0;
    meanRadiosity_ = all.area > 0 ? all.radiosity / all.area : 0;
}

/// Reflectances, and what follows from them. |B_exact - B| <= max|R| / (1 - max(rho * row sum)), in
/// the maximum norm; row sums are at most 1. Means over clusters differ from the exact ones by no
/// more than what they are the means of.
void IndirectLight::coloursChanged() {
    float most = 0;
    std::vector<glm::dvec3> colours;
    reflectances_.assign(blockCount(), 0.0f);
    for (std::uint32_t p = 0; p < set_.patches.size(); ++p) {
        const Patch& patch = set_.patches[p];
        const bool there = set_.parts.used.empty() || set_.parts.used[p];
        const Rgb colour = there ? patchReflectance(set_, p) : Rgb();
        const float rho = maxChannel(colour);
        colours.push_back(toDouble(colour));
        if (!there) continue;
        most = std::max(most, rho);
        const auto at = [&](std::uint32_t n) {
            reflectances_[n / kBlock] = std::max(reflectances_[n / kBlock], rho);
        };
        at(patch.centreNode);
        if (patch.hasCornerNodes) std::for_each_n(patch.cornerNodes.begin(), 4, at);
    }
    colours_ = senders_.average(colours);
    gain_ = 1 / (1 - double(most));
}

/// What is owed goes, on average, once over all surfaces and is reflected on: Cohen et al. 1988.
glm::dvec3 IndirectLight::ambient() const {
    glm::dvec3 owed(0), reflected(0);
    double area = 0;
    for (std::uint32_t p = 0; p < set_.patches.size(); ++p) {
        const double size =
            set_.parts.used.empty() || set_.parts.used[p] ? set_.patches[p].area : 0;
        owed += size * residuals_[p][0];
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
