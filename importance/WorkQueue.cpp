#include "importance/WorkQueue.h"

#include <algorithm>
#include <cassert>
#include <numbers>
#include <utility>

namespace penumbra {

/// Whether cluster a comes before cluster b. Of equals, one whose key is only a bound comes first:
/// what it holds may be older.
bool WorkQueue::before(std::uint32_t a, std::uint32_t b) const {
    const Cluster &one = clusters_[a], &other = clusters_[b];
    if (one.key != other.key) return one.key > other.key;
    if (one.ordered != other.ordered) return !one.ordered;
    if (one.ordered) return one.tasks.front().serial < other.tasks.front().serial;
    return a < b;
}

/// At least the priority of any task of a cluster, also after rounding.
double WorkQueue::boundOf(const Cluster& cluster) {
    if (cluster.tasks.empty()) return 0;
    return (1 + 1e-6) * priorityOf(cluster.value, cluster.mostChange, cluster.leastCost);
}

double WorkQueue::valueOf(const ClusterPriority& cluster, const TaskPriority& priority) {
    return priorityOf(cluster, priority.change, double(priority.cost) / double(priority.share));
}

double WorkQueue::value(Handle handle) const {
    return value(slots_[handle].task);
}

double WorkQueue::value(const Task& task) const {
    if (task.cluster < clusters_.size() && clusters_[task.cluster].keyed == rekeys_)
        return valueOf(clusters_[task.cluster].value, task.priority);
    return valueOf(value_ ? value_(task.cluster) : ClusterPriority(), task.priority);
}

WorkQueue::Handle WorkQueue::add(const Task& task) {
    if (free_.empty()) {
        free_.push_back(std::uint32_t(slots_.size()));
        slots_.emplace_back();
    }
    const Handle handle = free_.back();
    free_.pop_back();
    Slot& slot = slots_[handle];
    slot.task = task;
    slot.serial = ++serial_;
    slot.older = std::exchange(youngest_, handle);
    slot.younger = kNone;
    (slot.older != kNone ? slots_[slot.older].younger : oldest_) = handle;
    ++size_;
    insert(handle);
    return handle;
}

void WorkQueue::rank(Handle handle, const TaskPriority& priority) {
    slots_[handle].task.priority = priority;
    insert(handle);
}

/// Puts a task in the list of its cluster; its older entries there count no more.
void WorkQueue::insert(Handle handle) {
    Slot& slot = slots_[handle];
    const TaskPriority& priority = slot.task.priority;
    assert(priority.cost > 0 && priority.change >= 0 && priority.share > 0);
    slot.chosen = false;
    Cluster& at = clusterAt(slot.task.cluster);
    at.mostChange = std::max(at.mostChange, priority.change);
    at.leastCost = std::min(at.leastCost, priority.cost / priority.share);
    at.tasks.push_back({valueOf(at.value, priority), slot.serial, handle, ++slot.ranking});
    if (at.ordered) std::push_heap(at.tasks.begin(), at.tasks.end());
    if (at.position == kOut) {
        at.position = heap_.size();
        heap_.push_back(slot.task.cluster);
    }
    settle(slot.task.cluster);
}

/// A cluster whose key is that of the last rekey().
WorkQueue::Cluster& WorkQueue::clusterAt(std::uint32_t index) {
    if (index >= clusters_.size()) clusters_.resize(index + 1);
    Cluster& at = clusters_[index];
    if (at.keyed == rekeys_) return at;
    at.keyed = rekeys_;
    at.value = value_(index);
    at.ordered = false;
    at.key = boundOf(at);
    return at;
}

void WorkQueue::rekey(Value value) {
    value_ = std::move(value);
    ++rekeys_;
    for (std::uint32_t index : heap_) clusterAt(index);
    const auto after = [&](std::uint32_t a, std::uint32_t b) { return before(b, a); };
    std::make_heap(heap_.begin(), heap_.end(), after);
    for (std::size_t i = 0; i < heap_.size(); ++i) clusters_[heap_[i]].position = i;
}

void WorkQueue::rekey(std::uint32_t cluster, const ClusterPriority& value) {
    Cluster& at = clusterAt(cluster);
    at.value = value;
    at.ordered = false;
    if (at.position != kOut) settle(cluster);
}

/// Ranks all tasks of a cluster, and finds its exact key and bounds.
void WorkQueue::order(Cluster& cluster) {
    std::erase_if(cluster.tasks, [&](const Ranked& ranked) { return stale(ranked); });
    cluster.mostChange = 0;
    cluster.leastCost = std::numeric_limits<float>::infinity();
    for (Ranked& ranked : cluster.tasks) {
        const TaskPriority& priority = slots_[ranked.slot].task.priority;
        ranked.value = valueOf(cluster.value, priority);
        cluster.mostChange = std::max(cluster.mostChange, priority.change);
        cluster.leastCost = std::min(cluster.leastCost, priority.cost / priority.share);
    }
    std::make_heap(cluster.tasks.begin(), cluster.tasks.end());
    cluster.ordered = true;
}

/// Tasks that were removed or ranked anew leave their cluster's list only now.
void WorkQueue::skipStale(Cluster& cluster) {
    while (!cluster.tasks.empty() && stale(cluster.tasks.front())) {
        std::pop_heap(cluster.tasks.begin(), cluster.tasks.end());
        cluster.tasks.pop_back();
    }
}

/// Brings a cluster to where it belongs in the heap, or takes it out if nothing is left in it.
void WorkQueue::settle(std::uint32_t index) {
    Cluster& at = clusters_[index];
    if (at.ordered) skipStale(at);
    if (at.tasks.empty()) {
        const std::size_t hole = std::exchange(at.position, kOut);
        at.mostChange = 0;
        at.leastCost = std::numeric_limits<float>::infinity();
        const std::uint32_t last = heap_.back();
        heap_.pop_back();
        if (last == index) return;
        put(hole, last);
        rise(hole), sink(clusters_[last].position);
        return;
    }
    at.key = at.ordered ? at.tasks.front().value : boundOf(at);
    rise(at.position), sink(at.position);
}

void WorkQueue::remove(Handle handle) {
    Slot& slot = slots_[handle];
    assert(slot.serial != 0);
    slot.serial = 0;
    (slot.older != kNone ? slots_[slot.older].younger : oldest_) = slot.younger;
    (slot.younger != kNone ? slots_[slot.younger].older : youngest_) = slot.older;
    free_.push_back(handle);
    --size_;
}

/// The task of the highest priority that is in a list, if there is any.
std::optional<WorkQueue::Handle> WorkQueue::best() {
    while (!heap_.empty()) {
        const std::uint32_t index = heap_.front();
        Cluster& at = clusters_[index];
        if (at.ordered && !stale(at.tasks.front())) return at.tasks.front().slot;
        if (!at.ordered) order(at);
        settle(index);
    }
    return {};
}

std::optional<WorkQueue::Choice> WorkQueue::choose(double now) {
    if (empty()) return {};
    const Slot& oldest = slots_[oldest_];
    const bool overdue = now - oldest.task.since >= fairness_.aging;
    if (!overdue) owed_ = std::min(owed_, 0.0);
    const bool itsTurn = overdue && !oldest.chosen && owed_ >= 0;
    const std::optional<Handle> chosen = itsTurn ? oldest_ : best();
    if (!chosen) return {};
    slots_[*chosen].chosen = true;
    return Choice{*chosen, slots_[*chosen].task, itsTurn};
}

WorkQueue::TaskPriority WorkQueue::priorityFor(std::uint32_t cluster, double gain, double cost) {
    constexpr double kOne = std::numbers::phi; // g(kOne) = 1, see priorityOf()
    const ClusterPriority& at = clusterAt(cluster).value;
    const double share = at.weight > 0 ? gain / at.weight : 0;
    return {float(kOne / at.perThreshold), std::max(float(share), 1e-30f), float(cost)};
}

void WorkQueue::finish(const Choice& choice, double cost) {
    spend(choice, cost);
    remove(choice.handle);
}

void WorkQueue::finishPart(const Choice& choice, double cost, const TaskPriority& rest) {
    spend(choice, cost);
    rank(choice.handle, rest);
}

/// Overdue work has a share of all work.
void WorkQueue::spend(const Choice& choice, double cost) {
    if (choice.overdue)
        owed_ -= cost * (1 - fairness_.reserve);
    else
        owed_ += cost * fairness_.reserve;
}

std::optional<WorkQueue::Task> WorkQueue::take(double now) {
    const std::optional<Choice> choice = choose(now);
    if (!choice) return {};
    finish(*choice, double(choice->task.priority.cost));
    return choice->task;
}

double WorkQueue::oldest(double now) const {
    return empty() ? now : slots_[oldest_].task.since;
}

void WorkQueue::put(std::size_t position, std::uint32_t index) {
    heap_[position] = index;
    clusters_[index].position = position;
}

void WorkQueue::rise(std::size_t position) {
    const std::uint32_t index = heap_[position];
    while (position > 0) {
        const std::size_t parent = (position - 1) / 2;
        if (!before(index, heap_[parent])) break;
        put(position, heap_[parent]);
        position = parent;
    }
    put(position, index);
}

void WorkQueue::sink(std::size_t position) {
    const std::uint32_t index = heap_[position];
    for (;;) {
        std::size_t child = 2 * position + 1;
        if (child >= heap_.size()) break;
        if (child + 1 < heap_.size() && before(heap_[child + 1], heap_[child])) ++child;
        if (!before(heap_[child], index)) break;
        put(position, heap_[child]);
        position = child;
    }
    put(position, index);
}

} // namespace penumbra
