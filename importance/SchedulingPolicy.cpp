#include "importance/SchedulingPolicy.h"

#include "importance/ContrastSensitivity.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <numbers>

namespace penumbra {

namespace {

WorkQueue::Task taskFor(std::uint32_t cluster, double change, double cost) {
    WorkQueue::Task task;
    task.cluster = cluster;
    task.priority.change = float(change);
    task.priority.cost = float(cost);
    return task;
}

/// Finalisation mix of MurmurHash3 (Appleby, public domain): all bits of the result depend on all
/// of x.
std::uint32_t mixed(std::uint64_t x) {
    x = (x ^ x >> 33) * 0xff51afd7ed558ccdULL;
    x = (x ^ x >> 33) * 0xc4ceb9fe1a85ec53ULL;
    return std::uint32_t(x >> 32);
}

} // namespace

void SchedulingPolicy::gains(const CandidateBlock&, std::span<const float> change,
                             std::span<float> gains) {
    std::copy(change.begin(), change.end(), gains.begin());
}

WorkQueue::Task FixedPolicy::rank(const CandidateBlock& work) const {
    return taskFor(0, priority(work), 1);
}

ClusterPriority FixedPolicy::value(std::uint32_t) {
    return {1e-9, 1e9, false}; // the priority as it is, not by how well it is seen
}

double RandomPolicy::priority(const CandidateBlock& work) const {
    const std::uint64_t key = std::uint64_t(work.row) << 32 | work.block;
    return double(mixed(key ^ std::uint64_t(seed_) << 16) >> 8);
}

WorkQueue::Task ImportancePolicy::rank(const CandidateBlock& work) const {
    // What has no cluster of its own belongs to several: all of that counts as one more.
    const bool known =
        work.block < clusterOf_.size() && clusterOf_[work.block] != ReceiverClusters::kNowhere;
    const auto none = std::uint32_t(clusterOf_.size());
    return taskFor(known ? clusterOf_[work.block] : none, work.bound * std::numbers::inv_pi,
                   work.cost);
}
void ImportancePolicy::gains(const CandidateBlock& work, std::span<const float> change,
                             std::span<float> gains) {
    std::array<ClusterPriority, 64> values;
    assert(change.size() <= values.size());
    std::uint64_t which = 0;
    for (std::size_t r = 0; r < change.size(); ++r) which |= std::uint64_t(change[r] > 0) << r;
    sampleClosely(work.block, which, values);
    for (std::size_t r = 0; r < change.size(); ++r)
        gains[r] = float(priorityOf(values[r], double(change[r]) * std::numbers::inv_pi, 1));
}
ClusterPriority ImportancePolicy::value(std::uint32_t cluster) {
    if (!attention_) return {1e-12, 1, false};
    if (cluster >= clusterOf_.size()) return averageValue();
    const ViewSample known = sample(cluster);
    return clusterPriority(known.cluster, *attention_, known.seen);
}

/// Of a cluster in the picture, if a quarter of all is.
ClusterPriority ImportancePolicy::averageValue() const {
    ClusterPriority value;
    const double clusters = std::max(1.0, double(clusterOf_.size()) / 4);
    value.weight = attention_->factors.size ? attention_->viewpoint.pixels() / clusters : 1;
    value.anyChange = !attention_->factors.change;
    if (attention_->factors.contrast)
        value.perThreshold =
            peakContrastSensitivity(attention_->adaptation) / attention_->adaptation;
    return value;
}

} // namespace penumbra
