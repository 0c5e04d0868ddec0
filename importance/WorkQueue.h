// Tasks by priority, in a new order at once when the viewer moves.
#pragma once

#include "importance/Priority.h"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

namespace penumbra {

/// A priority queue of tasks. A task's priority has a part of its own (how far luminance may
/// change, at what cost) and a part that all tasks of a cluster share (ClusterPriority). When the
/// view changes only the latter is computed anew, cluster by cluster, with an upper bound of the
/// priorities there; the tasks themselves are only put in order when their cluster's turn comes.
/// The order is nevertheless exactly that of the tasks' priorities, ties broken by age.
///
/// What is known of a task may change while it is queued: rank() puts it where it belongs now, and
/// it keeps its age.
///
/// Nothing starves. A task that has waited for `aging` is overdue; of the cost of all work taken
/// from then on, the share `reserve` goes to what is overdue, the oldest first. So a task that was
/// added at time t with work of cost P ahead of it in age, itself among it, is taken before work of
/// cost P / reserve, and of one task more, is done after t + aging.
class WorkQueue {
public:
    struct Fairness {
        double aging = std::numeric_limits<double>::infinity(); ///< in the unit of `now`
        double reserve = 0.25;                                  ///< share of the cost, in (0, 1]
    };

    explicit WorkQueue(Fairness fairness) : fairness_(fairness) {}
    WorkQueue() : WorkQueue(Fairness()) {}
    void setAging(double aging) { fairness_.aging = aging; }

    /// What a task is ranked by, besides its cluster.
    struct TaskPriority {
        float change = 0; ///< of luminance where it changes, see priorityOf() [nit]
        float share = 1;  ///< of the cluster that changes, in (0, 1]
        float cost = 1;   ///< > 0
    };
    /// A piece of work to do; `id` is the caller's.
    struct Task {
        std::uint32_t cluster = 0;
        std::uint64_t id = 0;
        TaskPriority priority;
        double since = 0; ///< when it was added
    };
    using Handle = std::uint32_t; ///< of a queued task

    /// The priority that work of a cluster shares, as the viewer sees it now.
    using Value = std::function<ClusterPriority(std::uint32_t cluster)>;
    /// Asks anew for all clusters: at once for those with tasks, for others when tasks come.
    void rekey(Value value);
    /// The same for one cluster, as when its light was found to change less than was thought.
    void rekey(std::uint32_t cluster, const ClusterPriority& value);

    /// Adds a task. Before the first rekey() all have priority 0.
    /// \param task its `since` may not be before that of tasks added earlier
    Handle add(const Task& task);
    /// A task has another priority now.
    void rank(Handle handle, const TaskPriority& priority);
    /// A task goes by another id from now on.
    void setId(Handle handle, std::uint64_t id) { slots_[handle].task.id = id; }
    /// A task is done or void, and leaves the queue.
    void remove(Handle handle);

    struct Choice {
        Handle handle = 0;
        Task task;
        bool overdue = false; ///< comes for its age, not for its priority
    };
    /// The task of the highest priority, or the oldest if that is overdue and has its share. It
    /// stays queued and grows older, but is not chosen again before rank(); or it is done, see
    /// finish().
    /// \param now in any unit that rises; nothing if there is no work
    std::optional<Choice> choose(double now);
    /// A task that was chosen is going to be done.
    /// \param cost as far as it is known by now: it may be more than it was ranked by
    void finish(const Choice& choice, double cost);
    /// A part of it is going to be done; it stays queued, and the rest has this gain.
    void finishPart(const Choice& choice, double cost, const TaskPriority& rest);
    /// What to rank a task of a cluster by that gains so much as the viewer sees it now: when the
    /// view changes, it gains as much more or less as others there.
    TaskPriority priorityFor(std::uint32_t cluster, double gain, double cost);
    /// Chooses a task to be done.
    std::optional<Task> take(double now);

    /// Whether a cluster is in the picture, see ClusterPriority.
    bool inPicture(std::uint32_t cluster) { return clusterAt(cluster).value.inPicture; }
    /// What a queued task is ranked by now, see priorityOf().
    double value(Handle handle) const;
    /// What it would be ranked by if it were added.
    double value(const Task& task) const;

    std::size_t size() const { return size_; }
    bool empty() const { return size_ == 0; }
    /// When the oldest task was added; `now` if there is none.
    double oldest(double now) const;

private:
    /// A task in the order of its cluster. Serial numbers are also ages.
    struct Ranked {
        double value;
        std::uint64_t serial;
        std::uint32_t slot, ranking;
        bool operator<(const Ranked& o) const { // comes later
            return value != o.value ? value < o.value : serial > o.serial;
        }
    };
    struct Cluster {
        ClusterPriority value;
        std::uint32_t keyed = 0;   ///< at which rekey() it was asked for
        std::vector<Ranked> tasks; ///< a heap once it is `ordered`
        bool ordered = false;
        float mostChange = 0;                                     ///< of any task here
        float leastCost = std::numeric_limits<float>::infinity(); ///< over share
        double key = 0;              ///< of the best task, or a bound of it
        std::size_t position = kOut; ///< in heap_
    };
    struct Slot {
        Task task;
        std::uint64_t serial = 0;              ///< 0: free
        std::uint32_t ranking = 0;             ///< how often it was ranked
        Handle older = kNone, younger = kNone; ///< beside it in age
        bool chosen = false;                   ///< and not ranked since
    };
    static constexpr Handle kNone = ~Handle(0);
    static constexpr std::size_t kOut = ~std::size_t(0);

    Cluster& clusterAt(std::uint32_t index);
    bool before(std::uint32_t a, std::uint32_t b) const;
    static double boundOf(const Cluster& cluster);
    static double valueOf(const ClusterPriority& cluster, const TaskPriority& priority);
    void insert(Handle handle);
    /// Whether an entry of a cluster's list counts for nothing any more.
    bool stale(const Ranked& ranked) const {
        const Slot& slot = slots_[ranked.slot];
        return slot.serial != ranked.serial || slot.ranking != ranked.ranking || slot.chosen;
    }
    void spend(const Choice& choice, double cost);
    void order(Cluster& cluster);
    void skipStale(Cluster& cluster);
    std::optional<Handle> best();
    void put(std::size_t position, std::uint32_t index);
    void rise(std::size_t position);
    void sink(std::size_t position);
    void settle(std::uint32_t index);

    Fairness fairness_;
    Value value_;
    std::uint32_t rekeys_ = 0;
    std::vector<Cluster> clusters_;
    std::vector<std::uint32_t> heap_; ///< clusters with tasks, the one with the largest key first
    std::deque<Slot> slots_; ///< grows without being copied: that would take longer than a step
    std::vector<std::uint32_t> free_;
    Handle oldest_ = kNone, youngest_ = kNone;
    std::uint64_t serial_ = 0;
    std::size_t size_ = 0;
    double owed_ = 0; ///< to overdue work, of its share; below 0 it has had more
};

} // namespace penumbra
