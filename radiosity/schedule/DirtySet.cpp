#include "radiosity/schedule/DirtySet.h"

#include "base/Bits.h"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

namespace penumbra {

namespace {

/// See setAging(): until the speed of work is known.
constexpr WorkQueue::Fairness kFairness{.aging = 4e6, .reserve = 0.25};

} // namespace

DirtySet::DirtySet(std::size_t rows, const Costs& costs)
    : rows_(rows), costs_(costs), queue_(kFairness) {
    setPolicy(std::make_shared<BoundPolicy>());
}

std::size_t DirtySet::cost(const DirtyBlock& block) const {
    return costs_.visit + costs_.entry * std::size_t(std::popcount(block.anew));
}

void DirtySet::setPolicy(std::shared_ptr<SchedulingPolicy> policy) {
    policy_ = std::move(policy);
    queue_ = WorkQueue(kFairness);
    setAging(aging_);
    rekey();
    for (std::uint32_t row = 0; row < rows_.size(); ++row) {
        for (Entry& entry : rows_[row].entries) {
            entry.handle = kDeferred;
            if (!entry.dirty) continue;
            if (!policy_->probes()) forget(entry);
            if (entry.partial) entry.partial->unrank();
        }
        setUnsorted(row);
    }
}

void DirtySet::rekey() {
    queue_.rekey([policy = policy_](std::uint32_t cluster) { return policy->value(cluster); });
}

void DirtySet::setAging(double rays) {
    aging_ = rays;
    queue_.setAging(rays);
}

void DirtySet::setWhole(bool whole) {
    if (std::exchange(whole_, whole) == whole) return;
    for (std::uint32_t row = 0; row < rows_.size(); ++row)
        for (Entry& entry : rows_[row].entries)
            if (entry.dirty && entry.handle != kDeferred)
                queue_.rank(entry.handle, priorityFor(row, entry));
}

void DirtySet::setReceivers(std::vector<Receivers> blocks) {
    receivers_ = std::move(blocks);
    sums_.resize(receivers_.size());
}

void DirtySet::setPower(std::uint32_t row, double power) {
    RowList& list = rows_[row];
    if (list.power == power) return;
    if (list.dirty > 0)
        for (const Entry& entry : list.entries)
            if (entry.dirty)
                sums_[entry.block].light += double(entry.factor) * (power - list.power);
    list.power = power;
}

void DirtySet::add(std::uint32_t block, double factor, double power, int count) {
    Sum& sum = sums_[block];
    sum.count += std::uint32_t(count);
    count_ += std::size_t(count);
    // Rounding must not leave anything behind.
    sum.light = sum.count == 0 ? 0 : std::max(0.0, sum.light + factor * power);
    sum.factor = sum.count == 0 ? 0 : std::max(0.0, sum.factor + factor);
}

/// About [rays].
double DirtySet::costOf(const Entry& entry, std::uint64_t receivers) const {
    if (!entry.partial) return double(cost({0, entry.block, entry.anew & receivers, 0, 0}));
    return entry.partial->cost(receivers);
}

WorkQueue::Task DirtySet::task(std::uint32_t row, const Entry& entry) const {
    const Receivers& r = receivers_[entry.block];
    const double bound =
        double(r.reflectance) * double(entry.factor) * (rows_[row].power + double(r.light));
    const DirtyBlock block{row, entry.block, entry.anew, entry.since, entry.factor};
    // A probe may find that all the change is in a few receivers.
    const double expense = policy_->probes() ? double(cost::kProbedVisit) : double(cost(block));
    WorkQueue::Task task = policy_->rank({row, entry.block, bound, expense});
    task.since = taken_;
    return task;
}

/// Of a probed block: which of the remaining receivers come next, and with what priority.
WorkQueue::TaskPriority DirtySet::choosePart(std::uint32_t row, Entry& entry) {
    if (!entry.partial->isRanked(policy_->view())) rankReceivers(row, entry);
    const std::uint32_t cluster = task(row, entry).cluster;
    // Without a viewer, another visit costs more than an early part gains.
    const PartialUpdate::Part part = entry.partial->bestPart(whole_ || !queue_.inPicture(cluster));
    entry.part = part.receivers;
    return queue_.priorityFor(cluster, part.gain, part.cost);
}

void DirtySet::rankReceivers(std::uint32_t row, Entry& entry) {
    const Receivers& r = receivers_[entry.block];
    const ExpectedFactors& expected = entry.partial->expected();
    std::array<float, ExpectedFactors::kSize> change, gains;
    change.fill(0); // what is done is not asked for
    for (const std::size_t i : bitsOf(entry.left)) {
        change[i] = float(double(r.reflectance) * double(expected.factor[i]) *
                          (rows_[row].power + double(r.light)));
    }
    policy_->gains({row, entry.block, 0, 0}, change, gains);
    entry.partial->rank(entry.left, gains, policy_->view());
}

WorkQueue::TaskPriority DirtySet::priorityFor(std::uint32_t row, Entry& entry) {
    return entry.partial ? choosePart(row, entry) : task(row, entry).priority;
}

/// What was expected of a block.
void DirtySet::forget(Entry& entry) {
    entry.partial.reset();
    entry.part = entry.left;
}

void DirtySet::enqueue(std::uint32_t row, Entry& entry) {
    WorkQueue::Task one = task(row, entry);
    one.id = idOf(row, std::size_t(&entry - rows_[row].entries.data()));
    entry.handle = queue_.add(one);
    if (entry.partial) queue_.rank(entry.handle, choosePart(row, entry));
}

void DirtySet::deferred(Entry& entry) {
    if (const WorkQueue::Handle handle = std::exchange(entry.handle, kDeferred);
        handle != kDeferred)
        queue_.remove(handle);
}

/// There is more to it now. What is not deferred keeps its age.
void DirtySet::markAnew(std::uint32_t row, Entry& entry) {
    entry.left = ~std::uint64_t(0);
    forget(entry);
    if (entry.handle != kDeferred) queue_.rank(entry.handle, task(row, entry).priority);
}

void DirtySet::setUnsorted(std::uint32_t row) {
    RowList& list = rows_[row];
    if (list.dirty > 0 && !std::exchange(list.unsorted, true)) unsorted_.push_back(row);
}

/// Puts into the queue what belongs there; false: no step is left for it.
bool DirtySet::sort(double enough, std::size_t& steps) {
    for (; !unsorted_.empty() && steps > 0; unsorted_.pop_front()) {
        constexpr std::size_t kAtOnce = 8; // probed in the time of a step
        RowList& list = rows_[unsorted_.front()];
        list.unsorted = false;
        std::size_t queued = 0;
        for (Entry& entry : list.entries) {
            if (!entry.dirty || entry.handle != kDeferred) continue;
            if (enough > 0 && bound(entry.block) <= enough) continue;
            enqueue(unsorted_.front(), entry);
            ++queued;
        }
        steps -= std::min(steps, 1 + queued + list.entries.size() / kAtOnce);
    }
    return unsorted_.empty();
}

void DirtySet::mark(std::uint32_t row, std::span<const DirtyBlock> blocks) {
    if (blocks.empty()) return;
    RowList& list = rows_[row];
    std::vector<Entry> merged;
    merged.reserve(list.dirty + blocks.size());
    auto old = list.entries.begin();
    for (const DirtyBlock& block : blocks) {
        for (; old != list.entries.end() && old->block < block.block; ++old)
            if (old->dirty) merged.push_back(std::move(*old));
        const bool same = old != list.entries.end() && old->block == block.block;
        Entry entry = same ? std::move(*old++) : Entry{};
        if (entry.dirty) {
            const float before = entry.factor;
            entry.anew |= block.anew;
            entry.since = std::min(entry.since, block.since);
            entry.factor = std::max(before, block.factor);
            add(entry.block, double(entry.factor) - double(before), list.power, 0);
            markAnew(row, entry);
        } else {
            entry = {block.anew, block.block, block.since, block.factor};
            entry.dirty = true;
            add(entry.block, entry.factor, list.power, 1);
            ++list.dirty;
        }
        merged.push_back(std::move(entry));
    }
    for (; old != list.entries.end(); ++old)
        if (old->dirty) merged.push_back(std::move(*old));
    list.entries = std::move(merged);
    for (std::size_t e = 0; e < list.entries.size(); ++e)
        if (list.entries[e].handle != kDeferred) queue_.setId(list.entries[e].handle, idOf(row, e));
    setUnsorted(row);
}

void DirtySet::drop(std::uint32_t row) {
    RowList& list = rows_[row];
    for (Entry& entry : list.entries) {
        if (!entry.dirty) continue;
        add(entry.block, -double(entry.factor), list.power, -1);
        deferred(entry);
    }
    list.entries.clear();
    list.dirty = 0;
}

std::vector<std::uint32_t> DirtySet::urgent(std::uint32_t row, double enough) const {
    std::vector<std::uint32_t> blocks;
    for (const Entry& entry : rows_[row].entries)
        if (entry.dirty && bound(entry.block) > enough) blocks.push_back(entry.block);
    return blocks;
}

std::vector<DirtySet::AtBlock> DirtySet::atBlocks(double enough) const {
    std::vector<AtBlock> blocks(sums_.size());
    for (std::uint32_t row = 0; row < rows_.size(); ++row)
        for (const Entry& entry : rows_[row].entries) {
            if (!entry.dirty) continue;
            AtBlock& at = blocks[entry.block];
            ++(bound(entry.block) > enough ? at.rows : at.small);
            at.priority =
                std::max(at.priority, entry.handle != kDeferred ? queue_.value(entry.handle)
                                                                : queue_.value(task(row, entry)));
        }
    return blocks;
}

DirtySet::Entry* DirtySet::find(std::uint32_t row, std::uint32_t block) {
    std::vector<Entry>& entries = rows_[row].entries;
    const auto found =
        std::lower_bound(entries.begin(), entries.end(), block,
                         [](const Entry& entry, std::uint32_t at) { return entry.block < at; });
    return found != entries.end() && found->block == block && found->dirty ? &*found : nullptr;
}

std::optional<DirtyBlock> DirtySet::next(double enough, std::size_t& steps) {
    for (; steps > 0 && pending(enough); --steps) {
        if (queue_.empty() && unsorted_.empty()) // nothing is deferred any more
            for (std::uint32_t row = 0; row < rows_.size(); ++row) setUnsorted(row);
        if (!sort(enough, steps)) return {};
        const std::optional<WorkQueue::Choice> choice = queue_.choose(taken_);
        if (!choice) return {};
        const auto row = std::uint32_t(choice->task.id >> 32);
        const auto at = std::uint32_t(choice->task.id);
        Entry& entry = rows_[row].entries[at];
        if (enough > 0 && bound(entry.block) <= enough) {
            deferred(entry);
            continue;
        }
        const bool probes = !choice->overdue && policy_->probes();
        if (probes && entry.partial &&
            !entry.partial->isRanked(policy_->view())) { // the viewer has moved
            queue_.rank(entry.handle, choosePart(row, entry));
            continue;
        }
        const std::uint64_t receivers = choice->overdue ? entry.left : entry.part;
        return DirtyBlock{row,
                          entry.block,
                          entry.anew & receivers,
                          entry.since,
                          entry.factor,
                          receivers,
                          costOf(entry, receivers),
                          probes && !entry.partial,
                          choice->overdue,
                          at};
    }
    return {};
}

void DirtySet::clean(const DirtyBlock& block) {
    Entry& entry = rows_[block.row].entries[block.entry];
    const WorkQueue::Choice choice{entry.handle, {}, block.overdue};
    taken_ += block.cost;
    entry.left &= ~block.receivers;
    entry.anew &= ~block.receivers;
    if (entry.left != 0) {
        entry.partial->close(block.receivers);
        return queue_.finishPart(choice, block.cost, priorityFor(block.row, entry));
    }
    queue_.finish(choice, block.cost);
    entry.handle = kDeferred;
    finish(block.row, entry);
}

/// Of what is not in the queue.
void DirtySet::finish(std::uint32_t row, Entry& entry) {
    RowList& list = rows_[row];
    add(entry.block, -double(entry.factor), list.power, -1);
    entry.dirty = false;
    entry.partial.reset();
    if (--list.dirty == 0) list.entries.clear();
}

/// Whether any of it is still dirty.
bool DirtySet::narrow(std::uint32_t row, Entry& entry, std::uint64_t receivers) {
    entry.left &= receivers;
    if (entry.left != 0) return true;
    deferred(entry);
    finish(row, entry);
    return false;
}

void DirtySet::narrow(std::uint32_t row, std::uint32_t block, std::uint64_t receivers) {
    Entry* const entry = find(row, block);
    if (!entry || !narrow(row, *entry, receivers)) return;
    forget(*entry);
    entry->anew &= receivers;
    if (entry->handle != kDeferred) queue_.rank(entry->handle, task(row, *entry).priority);
}

void DirtySet::expect(std::uint32_t row, std::uint32_t block, const ExpectedFactors& expected) {
    Entry* const entry = find(row, block);
    if (!entry || !narrow(row, *entry, expected.dirty)) return;
    entry->partial = std::make_unique<PartialUpdate>(expected);
    if (entry->handle != kDeferred) queue_.rank(entry->handle, choosePart(row, *entry));
}

void DirtySet::putBack(const DirtyBlock& block) {
    Entry& entry = rows_[block.row].entries[block.entry];
    queue_.rank(entry.handle, priorityFor(block.row, entry));
}

std::optional<DirtyBlock> DirtySet::take(double enough, std::size_t& steps) {
    const std::optional<DirtyBlock> block = next(enough, steps);
    if (block) clean(*block);
    return block;
}

} // namespace penumbra
