// Ways of ordering dirty blocks.
#pragma once

#include "importance/Priority.h"
#include "importance/ReceiverClusters.h"
#include "importance/WorkQueue.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace penumbra {

/// A block of receivers in the row of one sender, with work to be done on it.
struct CandidateBlock {
    std::uint32_t row = 0, block = 0;
    double bound = 0; ///< of the change in what it reflects [lm/m^2]
    double cost = 1;  ///< about [rays]
};

/// Decides which dirty block comes first. Changes the order, never the answer.
class SchedulingPolicy {
public:
    virtual ~SchedulingPolicy() = default;

    /// The priority of a block: what is its own, and the cluster with which it shares the rest.
    virtual WorkQueue::Task rank(const CandidateBlock& work) const = 0;
    /// What all work at a cluster has in common now; asked for again whenever the view changes.
    virtual ClusterPriority value(std::uint32_t cluster) = 0;
    /// Whether a block is probed before it is worked on, to know what to expect of each of its
    /// receivers; those of the highest priority are then worked on before the others.
    virtual bool probes() const { return false; }
    /// What is gained at each receiver of a block that was probed, in the unit of value().
    /// \param change how far what it reflects is expected to change [lm/m^2]
    virtual void gains(const CandidateBlock& work, std::span<const float> change,
                       std::span<float> gains);
    /// Another number whenever gains() may be others.
    virtual std::uint32_t view() const { return 0; }
};

/// Knows no viewer: the priority of a block is one number, for good.
class FixedPolicy : public SchedulingPolicy {
public:
    WorkQueue::Task rank(const CandidateBlock& work) const override;
    ClusterPriority value(std::uint32_t cluster) override;
    /// >= 0, rounded to a float: the highest comes first, of equal ones the oldest.
    virtual double priority(const CandidateBlock& work) const = 0;
};

/// Sender by sender, and for each block by block: the original method, and the yardstick.
class PlainPolicy : public FixedPolicy {
public:
    double priority(const CandidateBlock& work) const override { return 1 / (1.0 + work.row); }
};

/// What may change most per cost, seen or not.
class BoundPolicy : public FixedPolicy {
public:
    double priority(const CandidateBlock& work) const override { return work.bound / work.cost; }
};

/// Any order, the same for the same seed.
class RandomPolicy : public FixedPolicy {
public:
    explicit RandomPolicy(std::uint32_t seed) : seed_(seed) {}
    double priority(const CandidateBlock& work) const override;

private:
    std::uint32_t seed_;
};

/// What the viewer gains most from per cost, see Priority.h. What is known of the view of a cluster
/// and of single receivers is up to those who derive from it.
class ImportancePolicy : public SchedulingPolicy {
public:
    /// \param clusterOf one a block; blocks that have none count as an average one in the picture
    explicit ImportancePolicy(std::vector<std::uint32_t> clusterOf)
        : clusterOf_(std::move(clusterOf)) {}

    WorkQueue::Task rank(const CandidateBlock& work) const override;
    ClusterPriority value(std::uint32_t cluster) override;
    bool probes() const override {
        return attention_ && attention_->factors.change && attention_->factors.probe;
    }
    void gains(const CandidateBlock& work, std::span<const float> change,
               std::span<float> gains) override;
    std::uint32_t view() const override { return view_; }

protected:
    /// What is known of a cluster when it is asked for: what shows there now, and how many pixels
    /// of it are seen, if that is known.
    struct ViewSample {
        ReceiverCluster cluster;
        std::optional<float> seen;
    };
    virtual ViewSample sample(std::uint32_t cluster) = 0;
    /// The same for some receivers (bits) of a block, and what it comes to.
    virtual void sampleClosely(std::uint32_t block, std::uint64_t which,
                               std::span<ClusterPriority> values) = 0;

    /// The viewer has moved, looks elsewhere, is adapted to another luminance. Before the first
    /// call there is no viewer.
    void setAttention(const Attention& attention) {
        attention_ = attention;
        ++view_;
    }
    /// \pre setAttention() was called
    const Attention& attention() const { return *attention_; }

private:
    ClusterPriority averageValue() const;

    std::vector<std::uint32_t> clusterOf_;
    std::optional<Attention> attention_;
    std::uint32_t view_ = 0;
};

} // namespace penumbra
