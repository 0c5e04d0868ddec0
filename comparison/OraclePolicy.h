// The policy of someone who knows what comes out.
#pragma once

#include "importance/SchedulingPolicy.h"
#include "radiosity/mesh/PatchSet.h"
#include "radiosity/query/DrawnView.h"
#include "radiosity/rows/Row.h"

#include <cstdint>
#include <span>
#include <vector>

namespace penumbra {

/// F V of all vertices, one list an emitter: what the rows say.
using VertexFactors = std::vector<std::vector<float>>;
VertexFactors factorsOf(std::span<const Row> rows, std::size_t vertices);

/// Blocks of direct light by how far they truly change what is seen, per cost: greedy, each block
/// by itself, so that lights that make up for one another count twice. A yardstick: no policy
/// that has to guess should be expected to be better.
///
///     gain = sum over receivers of pixels * g(|L_settled - L_now| / threshold)
class OraclePolicy : public SchedulingPolicy {
public:
    /// \param now      rows of the emitters as they are; must outlive this
    /// \param settled  the same when all work is done; must outlive this
    /// \param drawn    what is seen, and in how many pixels
    /// \param adaptation of the eye [nit]
    OraclePolicy(const PatchSet& patches, std::span<const Row> now, const VertexFactors& settled,
                 const DrawnView& drawn, double adaptation);

    WorkQueue::Task rank(const CandidateBlock& work) const override;
    bool probes() const override { return true; } // for what work costs
    void gains(const CandidateBlock& work, std::span<const float>,
               std::span<float> gains) override {
        trueGains(work, gains);
    }
    ClusterPriority value(std::uint32_t cluster) override;

private:
    void trueGains(const CandidateBlock& work, std::span<float> gains) const;

    const PatchSet& patches_;
    std::span<const Row> now_;
    const VertexFactors& settled_;
    std::vector<float> pixels_;        ///< one a vertex
    std::vector<float> reflectance_;   ///< likewise
    std::vector<double> perThreshold_; ///< likewise [1/nit]
};

} // namespace penumbra
