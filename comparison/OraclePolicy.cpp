#include "comparison/OraclePolicy.h"

#include "importance/Adaptation.h"
#include "importance/ContrastSensitivity.h"

#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

namespace penumbra {

VertexFactors factorsOf(std::span<const Row> rows, std::size_t vertices) {
    VertexFactors factors;
    for (const Row& row : rows) {
        std::vector<float>& one = factors.emplace_back(vertices);
        for (std::size_t b = 0; b < row.size(); ++b)
            row[b].forEach(
                [&](int r, float factor) { one[b * PatchSet::kBlock + std::size_t(r)] = factor; });
    }
    return factors;
}

OraclePolicy::OraclePolicy(const PatchSet& patches, std::span<const Row> now,
                           const VertexFactors& settled, const DrawnView& drawn, double adaptation)
    : patches_(patches), now_(now), settled_(settled), pixels_(drawn.vertexPixels()),
      reflectance_(patches.vertices.size()), perThreshold_(patches.vertices.size()) {
    for (std::uint32_t e = 0; e < patches.elements.size(); ++e)
        for (std::uint32_t v : patches.elements[e].vertices)
            reflectance_[v] = luminance(elementReflectance(patches, e));
    for (std::size_t v = 0; v < perThreshold_.size(); ++v) {
        double light = 0; // [lux]
        for (std::size_t row = 0; row < settled.size(); ++row)
            light += settled[row][v] * luminance(patches.emitters[row].exitance);
        const double adapted =
            localAdaptation(reflectance_[v] * light * std::numbers::inv_pi, adaptation);
        perThreshold_[v] = peakContrastSensitivity(adapted) / adapted;
    }
}

WorkQueue::Task OraclePolicy::rank(const CandidateBlock& work) const {
    std::array<float, PatchSet::kBlock> gain;
    trueGains(work, gain);
    WorkQueue::Task task;
    task.priority.change = std::accumulate(gain.begin(), gain.end(), 0.0f);
    task.priority.cost = float(work.cost);
    return task;
}

void OraclePolicy::trueGains(const CandidateBlock& work, std::span<float> gains) const {
    const std::size_t first = std::size_t(work.block) * PatchSet::kBlock;
    const std::vector<float>& settled = settled_[work.row];
    std::array<float, PatchSet::kBlock> change{}; // of F V
    for (std::size_t r = 0; r < change.size() && first + r < settled.size(); ++r)
        change[r] = settled[first + r];
    now_[work.row][work.block].forEach(
        [&](int r, float factor) { change[std::size_t(r)] -= factor; });
    const double power = luminance(patches_.emitters[work.row].exitance);
    for (std::size_t r = 0; r < change.size(); ++r) {
        const std::size_t v = first + r;
        const double nits = std::abs(change[r]) * power * reflectance_[v] * std::numbers::inv_pi;
        gains[r] = float(priorityOf({pixels_[v], perThreshold_[v], false}, nits, 1));
    }
}

ClusterPriority OraclePolicy::value(std::uint32_t) {
    return {1e-9, 1e9, false}; // the gain as it is
}

} // namespace penumbra
