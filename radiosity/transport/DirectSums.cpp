// H_direct at vertices, from the rows; its means over patches and their cells.
#include "radiosity/rows/SeenShare.h"
#include "radiosity/schedule/WorkCosts.h"
#include "radiosity/transport/DirectLight.h"

#include "base/Bits.h"
#include "base/Parallel.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>
#include <vector>

namespace penumbra {

namespace {

constexpr std::uint32_t kBlock = PatchSet::kBlock;

/// How much receivers see of an emitter of what is above their horizon.
class SeenShares {
public:
    SeenShares(const Row& row, const EmitterSender& sender, std::span<const Receiver> receivers)
        : row_(row), sender_(sender), receivers_(receivers) {}

    /// Negative: nothing of it is above the horizon.
    float at(std::uint32_t vertex) {
        const float known = ofBlock(vertex / kBlock)[vertex % kBlock];
        if (known >= 0) return known;
        return sender_.formFactor(receivers_[vertex]) > 0 ? 0.0f : -1.0f; // a wall hides it
    }

private:
    using Shares = std::array<float, kBlock>;
    const Shares& ofBlock(std::uint32_t block) {
        for (const auto& [index, shares] : blocks_)
            if (index == block) return shares;
        Shares& shares = blocks_.emplace_back(block, Shares()).second;
        shares.fill(-1);
        for (const std::uint32_t r : bitsOf(row_[block].present())) shares[r] = 0;
        row_[block].forEachSeen([&](int r, float formFactor, float seen) {
            shares[std::size_t(r)] = seen / formFactor;
        });
        return shares;
    }

    const Row& row_;
    const EmitterSender& sender_;
    std::span<const Receiver> receivers_;
    std::vector<std::pair<std::uint32_t, Shares>> blocks_;
};

} // namespace

std::array<float, kBlock> DirectLight::factors(std::uint32_t emitter, std::uint32_t block) const {
    std::array<float, kBlock> factors{};
    const Row& row = table_[emitter];
    if (block >= row.size()) return factors;
    if (!set_.isBlended(block)) {
        row[block].forEach([&](int r, float factor) { factors[std::size_t(r)] = factor; });
        return factors;
    }
    SeenShares shares(row, emitters_[emitter], receivers_);
    for (std::uint32_t r = 0; r < kBlock; ++r) {
        const std::uint32_t v = block * kBlock + r;
        SeenShare seen;
        set_.forEachReceiver(v, [&](std::uint32_t receiver, float weight) {
            seen.add(weight, shares.at(receiver));
        });
        if (seen.mean() > 0)
            factors[r] = seen.mean() * emitters_[emitter].formFactor(set_.vertices[v].receiver);
    }
    return factors;
}

void DirectLight::sumBlock(std::uint32_t block) {
    Rgb* const light = vertices_.data() + block * kBlock;
    float* const seen = vertexSeen_.data() + block * kBlock;
    std::fill_n(light, kBlock, Rgb());
    std::fill_n(seen, kBlock, 0.0f);
    for (const std::uint32_t e : order_) {
        const Rgb exitance = set_.emitters[e].exitance;
        const auto add = [&](int r, float factor) {
            light[r] += factor * exitance;
            seen[r] += factor;
        };
        if (!set_.isBlended(block)) {
            table_[e][block].forEach(add);
            continue;
        }
        const std::array<float, kBlock> blended = factors(e, block);
        for (int r = 0; r < int(kBlock); ++r) add(r, blended[std::size_t(r)]);
    }
}

bool DirectLight::averagePatches(std::size_t effort) {
    if (touchedPatches_.empty()) return false;
    const std::size_t each =
        cost::kMean + cost::kMeanElement * set_.elements.size() / set_.patches.size();
    const std::size_t count =
        std::min(touchedPatches_.size(), std::max<std::size_t>(2, effort / each));
    const auto some = std::span(touchedPatches_).last(count);
    std::vector<std::uint8_t> before(count);
    for (std::size_t i = 0; i < count; ++i) before[i] = patchLit_[some[i]];
    parallelFor(count, 16, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) average(some[i]);
    });
    for (std::size_t i = 0; i < count; ++i) {
        patchTouched_[some[i]] = 0;
        litChanged_ |= before[i] != patchLit_[some[i]];
    }
    touchedPatches_.resize(touchedPatches_.size() - count);
    return true;
}

/// Calls visit(element, number of its corners) for what is lit and seen of a patch.
template <class Visit>
void DirectLight::forEachLit(std::uint32_t patch, Visit visit) const {
    const Patch& p = set_.patches[patch];
    const std::uint32_t count = set_.sends(patch) ? p.elementCount : 0;
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t e = set_.patchElements[p.firstElement + i];
        if (set_.receives(e)) visit(set_.elements[e], set_.elements[e].isTriangle() ? 3u : 4u);
    }
}

/// Mean over the elements that are not covered.
void DirectLight::average(std::uint32_t index) {
    glm::dvec3 sum(0);
    double area = 0;
    bool lit = false;
    forEachLit(index, [&](const Element& element, std::size_t corners) {
        const double size = elementArea(set_, element);
        glm::dvec3 mean(0);
        for (std::size_t k = 0; k < corners; ++k) {
            const Rgb light = vertices_[element.vertices[k]];
            mean += glm::dvec3(light.r, light.g, light.b) / double(corners);
            lit |= vertexSeen_[element.vertices[k]] > 0;
        }
        sum += size * mean;
        area += size;
    });
    patches_[index] = area > 0 ? sum / area : glm::dvec3(0);
    patchLit_[index] = lit;
    if (!cells_.empty() && set_.patches[index].elementCount > 1) averageCells(index);
}

/// What the nearest element has, shifted so that the cells have the patch's mean: 16 places of
/// many elements may miss that.
void DirectLight::averageCells(std::uint32_t index) {
    std::array<glm::vec3, kPatchSamples> samples;
    samplePatch(set_, set_.patches[index], samples.data());
    std::array<float, kPatchSamples> nearest;
    nearest.fill(std::numeric_limits<float>::max());
    cells_[index].fill(Rgb());
    forEachLit(index, [&](const Element& element, std::size_t corners) {
        glm::vec3 middle(0);
        Rgb mean;
        for (std::size_t k = 0; k < corners; ++k) {
            middle += set_.vertices[element.vertices[k]].position / float(corners);
            mean += (1.0f / float(corners)) * vertices_[element.vertices[k]];
        }
        for (std::size_t k = 0; k < kPatchSamples; ++k) {
            const glm::vec3 d = samples[k] - middle;
            if (glm::dot(d, d) >= nearest[k]) continue;
            nearest[k] = glm::dot(d, d);
            cells_[index][k] = mean;
        }
    });
    Rgb missing{float(patches_[index].x), float(patches_[index].y), float(patches_[index].z)};
    for (const Rgb& cell : cells_[index]) missing -= (1.0f / kPatchSamples) * cell;
    for (Rgb& cell : cells_[index]) cell += missing;
}

} // namespace penumbra
