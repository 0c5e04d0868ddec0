// Blocks of rows that are to be brought up to date: the most promising first, and what all of them
// may change at most.
#pragma once

#include "importance/SchedulingPolicy.h"
#include "radiosity/schedule/PartialUpdate.h"

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace penumbra {

/// One block of one row that edits concern.
struct DirtyBlock {
    std::uint32_t row = 0, block = 0;
    std::uint64_t anew = 0;                      ///< bits: entries to be evaluated anew
    std::uint32_t since = 0;                     ///< how many edits its entries have taken in
    float factor = 0;                            ///< F V of no entry changes by more
    std::uint64_t receivers = ~std::uint64_t(0); ///< bits: of which entries are to be worked on
    double cost = 1;                             ///< from next(): about [rays]
    bool probe = false;                          ///< from next(): probe first, see expect()
    bool overdue = false;                        ///< from next(): comes for its age
    std::uint32_t entry = 0;                     ///< from next(): its index in the dirty set
};

/// The dirty blocks of rows, each with a bound of what it may change, found before any ray is
/// traced. An entry of a receiver r and a sender s, whose F V changes by f at most, changes what
/// r reflects by
///
///     rho_r f (|S_s| + H_r)
///
/// where |S_s| is what s has sent [lm/m^2], and H_r the light at r [lux], for r's row sum, by which
/// its light is divided (docs/radiosity.md, section 6), changes by f as well. Bounds are summed up
/// for each block of receivers, over all senders. Where the sum is small enough already, the rest
/// is deferred: it stays dirty, and its bound is part of what is reported.
///
/// A policy that probes blocks has them done in parts, see PartialUpdate.
class DirtySet {
public:
    /// What working on a block takes, about [rays].
    struct Costs {
        std::size_t visit; ///< of a block of which nothing is evaluated anew
        std::size_t entry; ///< more, for each entry that is
    };

    /// With the policy bound / cost, until another is set.
    DirtySet(std::size_t rows, const Costs& costs);
    /// More rows, of which nothing is dirty.
    void grow(std::size_t rows) { rows_.resize(rows); }
    std::size_t rows() const { return rows_.size(); }
    /// Another policy for all that is dirty, and for what comes.
    void setPolicy(std::shared_ptr<SchedulingPolicy> policy);
    /// The viewer has moved: priorities are asked for again.
    void rekey();
    /// What waits for longer than this gets a share of the work, whatever has a higher priority
    /// [rays].
    void setAging(double rays);
    /// Whether blocks are never done in parts, as where they are shown as wholes only.
    void setWhole(bool whole);
    /// What working on a block costs, about [rays].
    std::size_t cost(const DirtyBlock& block) const;

    /// What the receivers of a block make of light that changes.
    struct Receivers {
        float reflectance = 1, light = 0; ///< the largest; [lux]
    };
    /// Of all blocks; there may be more of them than before.
    void setReceivers(std::vector<Receivers> blocks);
    /// What a sender has sent [lm/m^2].
    void setPower(std::uint32_t row, double power);

    /// Marks blocks of one row as dirty, in order. Those that are so already are so for both
    /// reasons then.
    void mark(std::uint32_t row, std::span<const DirtyBlock> blocks);
    /// Closes all of a row.
    void drop(std::uint32_t row);
    /// The next block. It stays dirty: it is to be closed and worked on now, or ranked again by
    /// expect() or putBack().
    /// \param enough what may stay dirty on each block of receivers [lm/m^2]; 0: nothing
    /// \param steps blocks to go through at most, about; those that were are taken off
    /// \return nothing: none is left, or no step
    std::optional<DirtyBlock> next(double enough, std::size_t& steps);
    /// Is worked on, and not dirty any more but for receivers that are not among its own.
    /// \param block from next()
    void clean(const DirtyBlock& block);
    /// What is expected of a dirty block, which is closed if nothing is; a clean one is left alone.
    void expect(std::uint32_t row, std::uint32_t block, const ExpectedFactors& expected);
    /// Of a dirty block only these receivers (bits) are still to be worked on; if none is, it is
    /// closed. A clean one is left alone.
    void narrow(std::uint32_t row, std::uint32_t block, std::uint64_t receivers);
    void putBack(const DirtyBlock& block); ///< from next(): not now
    /// next() and clean().
    std::optional<DirtyBlock> take(double enough, std::size_t& steps);

    /// Whether take() may give anything.
    bool pending(double enough) const {
        return count_ > 0 && (enough <= 0 || !queue_.empty() || !unsorted_.empty());
    }
    std::size_t count() const { return count_; } ///< dirty blocks
    /// Cost of all work so far: the clock by which work waits [rays].
    double taken() const { return taken_; }
    /// When, by that clock, the dirty block was queued that has waited longest; nothing: none
    /// waits.
    std::optional<double> oldest() const {
        return queue_.empty() ? std::nullopt : std::optional(queue_.oldest(taken_));
    }
    /// Dirty blocks of a row, of receivers of which more than `enough` is dirty, in order.
    std::vector<std::uint32_t> urgent(std::uint32_t row, double enough) const;
    /// What is dirty of one block of receivers, over all rows.
    struct AtBlock {
        std::uint32_t rows = 0, small = 0; ///< more than `enough`; of blocks for which it is not
        double priority = 0;               ///< the largest by which any of it is ranked
    };
    /// Of every block; takes time in proportion to the dirty set.
    std::vector<AtBlock> atBlocks(double enough) const;
    /// Sums over the dirty blocks of all senders: of factor * power [lux], and of factor.
    double light(std::size_t block) const { return sums_[block].light; }
    double factor(std::size_t block) const { return sums_[block].factor; }
    std::size_t blocks() const { return sums_.size(); }
    /// What may change in what the receivers of a block reflect [lm/m^2].
    double bound(std::size_t block) const {
        const Receivers& r = receivers_[block];
        return double(r.reflectance) * (sums_[block].light + sums_[block].factor * double(r.light));
    }

private:
    static constexpr WorkQueue::Handle kDeferred = ~WorkQueue::Handle(0);
    struct Entry {
        std::uint64_t anew;
        std::uint32_t block, since;
        float factor;
        WorkQueue::Handle handle = kDeferred; ///< in the queue
        bool dirty = false;
        std::uint64_t left = ~std::uint64_t(0), part = ~std::uint64_t(0); ///< bits: receivers
        std::unique_ptr<PartialUpdate> partial{};                         ///< if it was probed
    };
    struct RowList {
        std::vector<Entry> entries; ///< by block
        std::size_t dirty = 0;      ///< of those
        bool unsorted = false;      ///< is in unsorted_
        double power = 0;
    };
    struct Sum {
        double light = 0, factor = 0;
        std::uint32_t count = 0;
    };
    static std::uint64_t idOf(std::uint32_t row, std::size_t entry) {
        return std::uint64_t(row) << 32 | entry;
    }
    WorkQueue::Task task(std::uint32_t row, const Entry& entry) const;
    double costOf(const Entry& entry, std::uint64_t receivers) const;
    void rankReceivers(std::uint32_t row, Entry& entry);
    WorkQueue::TaskPriority choosePart(std::uint32_t row, Entry& entry);
    WorkQueue::TaskPriority priorityFor(std::uint32_t row, Entry& entry);
    void forget(Entry& entry);
    bool narrow(std::uint32_t row, Entry& entry, std::uint64_t receivers);
    void finish(std::uint32_t row, Entry& entry);
    void enqueue(std::uint32_t row, Entry& entry);
    void markAnew(std::uint32_t row, Entry& entry);
    void deferred(Entry& entry);
    void setUnsorted(std::uint32_t row);
    bool sort(double enough, std::size_t& steps);
    void add(std::uint32_t block, double factor, double power, int count);
    Entry* find(std::uint32_t row, std::uint32_t block);

    std::vector<RowList> rows_;
    std::vector<Sum> sums_;            ///< a block of receivers each
    std::vector<Receivers> receivers_; ///< likewise
    Costs costs_;
    std::shared_ptr<SchedulingPolicy> policy_;
    bool whole_ = false;
    double aging_ = 4e6;                 ///< [rays]
    WorkQueue queue_;                    ///< of all that is not deferred
    std::deque<std::uint32_t> unsorted_; ///< rows of which some may belong in the queue that is not
    std::size_t count_ = 0;
    double taken_ = 0; ///< cost of all work so far: the queue's clock
};

} // namespace penumbra
