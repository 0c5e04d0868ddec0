// Ways of ordering open work.
#pragma once

#include "importance/Priority.h"
#include "importance/ReceiverClusters.h"
#include "importance/WorkQueue.h"

#include <cstdint>
#include <functional>
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

/// What decides which block of open work comes first. Changes the order, never the answer.
class SchedulingPolicy {
public:
    virtual ~SchedulingPolicy() = default;

    /// How a block is ranked: its place, which stays, and what the work there is worth.
    virtual WorkQueue::Task rank(const CandidateBlock& work) const = 0;
    /// Whether a block is looked at, before it is worked on, to know what to expect of each of its
    /// receivers; those that are worth it are then worked on before the others.
    virtual bool probes() const { return false; }
    /// What is gained at each receiver of a block that was looked at, in the unit of value().
    /// \param change how far what it reflects is expected to change [lm/m^2]
    virtual void gains(const CandidateBlock& work, std::span<const float> change,
                       std::span<float> gains) const;
    /// Another number whenever gains() may be others.
    virtual std::uint32_t view() const { return 0; }
    /// What all work at a place is worth now; asked for again whenever the view changes.
    virtual ClusterPriority value(std::uint32_t cluster) const = 0;
};

/// Sender by sender, and for each block by block: the original method, and the yardstick.
class PlainPolicy : public SchedulingPolicy {
public:
    WorkQueue::Task rank(const CandidateBlock& work) const override;
    ClusterPriority value(std::uint32_t cluster) const override;
};

/// What may change most per cost, seen or not.
class BoundPolicy : public SchedulingPolicy {
public:
    WorkQueue::Task rank(const CandidateBlock& work) const override;
    ClusterPriority value(std::uint32_t cluster) const override;
};

/// Any order, the same for the same seed.
class RandomPolicy : public SchedulingPolicy {
public:
    explicit RandomPolicy(std::uint32_t seed) : seed_(seed) {}
    WorkQueue::Task rank(const CandidateBlock& work) const override;
    ClusterPriority value(std::uint32_t cluster) const override;

private:
    std::uint32_t seed_;
};

/// What the viewer gains most from per cost, see Priority.h.
class ImportancePolicy : public SchedulingPolicy {
public:
    /// What is known of a place when it is asked for: what shows there now, and how many pixels of
    /// it are seen, if that is known.
    struct ViewSample {
        ReceiverCluster cluster;
        std::optional<float> seen;
    };
    using Probe = std::function<ViewSample(std::uint32_t cluster)>;
    /// The same for some receivers (bits) of a block, and what it comes to.
    using CloseProbe = std::function<void(std::uint32_t block, std::uint64_t which,
                                          std::span<ClusterPriority> values)>;

    /// \param clusterOf one a block; blocks that have none count as an average one in the picture
    /// \param closeProbe without it no block is looked at
    ImportancePolicy(std::vector<std::uint32_t> clusterOf, Probe probe, CloseProbe closeProbe = {})
        : clusterOf_(std::move(clusterOf)), probe_(std::move(probe)),
          closeProbe_(std::move(closeProbe)) {}

    /// The viewer has moved, looks elsewhere, is adapted to another luminance. Until the first
    /// time, nobody looks.
    void attend(const Attention& attention) {
        attention_ = attention;
        ++view_;
    }
    /// \pre attend() was called
    const Attention& attention() const { return *attention_; }

    bool probes() const override {
        return closeProbe_ && attention_ && attention_->factors.change && attention_->factors.probe;
    }
    void gains(const CandidateBlock& work, std::span<const float> change,
               std::span<float> gains) const override;
    std::uint32_t view() const override { return view_; }
    WorkQueue::Task rank(const CandidateBlock& work) const override;
    ClusterPriority value(std::uint32_t cluster) const override;

private:
    ClusterPriority averageValue() const;

    std::vector<std::uint32_t> clusterOf_;
    Probe probe_;
    CloseProbe closeProbe_;
    std::optional<Attention> attention_;
    std::uint32_t view_ = 0;
};

} // namespace penumbra
