#include "radiosity/OpenWork.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace penumbra {

namespace {

/// What waits for longer than this gets a share of the work, whatever else is worth more [rays]:
/// about a second of one thread.
constexpr WorkQueue::Fairness kFairness{.patience = 4e6, .reserve = 0.25};

} // namespace

OpenWork::OpenWork(std::size_t rows, std::size_t visitCost)
    : rows_(rows), visitCost_(visitCost), urgent_(kFairness), later_(kFairness) {
    setOrder(std::make_shared<const BoundOrder>());
}

std::size_t OpenWork::cost(const OpenBlock& block) const {
    constexpr std::size_t kSamples = 20; // of an entry that is evaluated anew
    return visitCost_ + kSamples * std::size_t(std::popcount(block.anew));
}

void OpenWork::setOrder(std::shared_ptr<const OrderOfWork> order) {
    order_ = std::move(order);
    clearQueues();
    for (std::uint32_t row = 0; row < rows_.size(); ++row)
        for (Entry& entry : rows_[row].entries)
            if (entry.ticket != 0) enqueue(row, entry);
}

void OpenWork::clearQueues() {
    urgent_ = later_ = WorkQueue(kFairness);
    rekey();
}

void OpenWork::rekey() {
    for (WorkQueue* queue : {&urgent_, &later_})
        queue->rekey([order = order_](std::uint32_t place) { return order->value(place); });
}

void OpenWork::setReceivers(std::vector<Receivers> blocks) {
    receivers_ = std::move(blocks);
    sums_.resize(receivers_.size());
}

void OpenWork::setPower(std::uint32_t row, double power) {
    RowList& list = rows_[row];
    if (list.power == power) return;
    if (list.open > 0)
        for (const Entry& entry : list.entries)
            if (entry.ticket != 0)
                sums_[entry.block].light += double(entry.factor) * (power - list.power);
    list.power = power;
}

void OpenWork::add(std::uint32_t block, double factor, double power, int count) {
    Sum& sum = sums_[block];
    sum.count += std::uint32_t(count);
    count_ += std::size_t(count);
    // Rounding must not leave anything behind.
    sum.light = sum.count == 0 ? 0 : std::max(0.0, sum.light + factor * power);
    sum.factor = sum.count == 0 ? 0 : std::max(0.0, sum.factor + factor);
}

void OpenWork::enqueue(std::uint32_t row, Entry& entry) {
    const Receivers& r = receivers_[entry.block];
    const double bound =
        double(r.reflectance) * double(entry.factor) * (rows_[row].power + double(r.light));
    const OpenBlock block{row, entry.block, entry.anew, entry.since, entry.factor};
    WorkQueue::Task task = order_->rank({row, entry.block, bound, double(cost(block))});
    entry.ticket = ++tickets_ == 0 ? ++tickets_ : tickets_;
    task.id = std::uint64_t(row) << 32 | entry.block;
    task.ticket = entry.ticket;
    task.since = taken_;
    urgent_.add(task);
}

void OpenWork::open(std::uint32_t row, std::span<const OpenBlock> blocks) {
    if (blocks.empty()) return;
    RowList& list = rows_[row];
    std::vector<Entry> merged;
    merged.reserve(list.open + blocks.size());
    auto old = list.entries.begin();
    for (const OpenBlock& block : blocks) {
        for (; old != list.entries.end() && old->block < block.block; ++old)
            if (old->ticket != 0) merged.push_back(*old);
        Entry entry{block.anew, block.block, block.since, block.factor, 0};
        const bool same = old != list.entries.end() && old->block == block.block;
        const Entry before = same ? *old++ : Entry{};
        const bool known = before.ticket != 0;
        if (known) {
            entry = {entry.anew | before.anew, entry.block, std::min(entry.since, before.since),
                     std::max(entry.factor, before.factor), before.ticket};
            add(entry.block, double(entry.factor) - double(before.factor), list.power, 0);
        } else {
            add(entry.block, entry.factor, list.power, 1);
            ++list.open;
        }
        // Its place in the queue was for less: that one counts for nothing any more.
        if (!known || entry.factor > before.factor || entry.anew != before.anew)
            enqueue(row, entry);
        merged.push_back(entry);
    }
    for (; old != list.entries.end(); ++old)
        if (old->ticket != 0) merged.push_back(*old);
    list.entries = std::move(merged);
}

void OpenWork::drop(std::uint32_t row) {
    RowList& list = rows_[row];
    for (const Entry& entry : list.entries)
        if (entry.ticket != 0) add(entry.block, -double(entry.factor), list.power, -1);
    list.entries.clear();
    list.open = 0;
}

std::vector<std::uint32_t> OpenWork::urgent(std::uint32_t row, double enough) const {
    std::vector<std::uint32_t> blocks;
    for (const Entry& entry : rows_[row].entries)
        if (entry.ticket != 0 && bound(entry.block) > enough) blocks.push_back(entry.block);
    return blocks;
}

OpenWork::Entry* OpenWork::find(const WorkQueue::Task& task) {
    std::vector<Entry>& entries = rows_[task.id >> 32].entries;
    const auto block = std::uint32_t(task.id);
    const auto found =
        std::lower_bound(entries.begin(), entries.end(), block,
                         [](const Entry& entry, std::uint32_t at) { return entry.block < at; });
    const bool same =
        found != entries.end() && found->block == block && found->ticket == task.ticket;
    return same ? &*found : nullptr;
}

std::optional<OpenBlock> OpenWork::take(double enough, std::size_t& steps) {
    for (; steps > 0 && pending(enough); --steps) {
        if (urgent_.empty()) std::swap(urgent_, later_);
        const std::optional<WorkQueue::Task> task = urgent_.take(taken_);
        Entry* const entry = find(*task);
        if (!entry) continue;
        if (enough > 0 && bound(entry->block) <= enough) {
            WorkQueue::Task putOff = *task;
            putOff.since = taken_;
            later_.add(putOff);
            continue;
        }
        const auto row = std::uint32_t(task->id >> 32);
        RowList& list = rows_[row];
        const OpenBlock taken{row, entry->block, entry->anew, entry->since, entry->factor};
        add(entry->block, -double(entry->factor), list.power, -1);
        entry->ticket = 0;
        if (--list.open == 0) list.entries.clear();
        if (count_ == 0) clearQueues(); // tasks that count for nothing
        taken_ += double(cost(taken));
        return taken;
    }
    return {};
}

} // namespace penumbra
