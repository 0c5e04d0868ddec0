#include "radiosity/OpenWork.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace penumbra {

namespace {

/// What waits for longer than this gets a share of the work, whatever else is worth more [rays]:
/// about a second of one thread.
constexpr WorkQueue::Fairness kFairness{.patience = 4e6, .reserve = 0.25};

/// What a block costs besides its rays, if their number is known [rays].
constexpr double kVisit = 48;

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
    urgent_ = later_ = WorkQueue(kFairness);
    rekey();
    for (std::uint32_t row = 0; row < rows_.size(); ++row)
        for (Entry& entry : rows_[row].entries)
            if (entry.open) entry.putOff = 0, enqueue(row, entry);
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
            if (entry.open) sums_[entry.block].light += double(entry.factor) * (power - list.power);
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

WorkQueue::Task OpenWork::task(std::uint32_t row, const Entry& entry) const {
    const Receivers& r = receivers_[entry.block];
    const auto change = [&](double factor) {
        return double(r.reflectance) * factor * (rows_[row].power + double(r.light));
    };
    const OpenBlock block{row, entry.block, entry.anew, entry.since, entry.factor};
    BlockOfWork work{row, entry.block, change(entry.factor), double(cost(block))};
    if (entry.looked) {
        work.expected = ExpectedChange{change(entry.expected.factor), entry.expected.share};
        work.cost = kVisit + double(entry.expected.rays);
    }
    WorkQueue::Task task = order_->rank(work);
    task.id = std::uint64_t(row) << 32 | entry.block;
    task.since = taken_;
    return task;
}

void OpenWork::enqueue(std::uint32_t row, Entry& entry) {
    entry.handle = queueOf(entry).add(task(row, entry));
}

/// There is more to it now. What was not put off keeps its age.
void OpenWork::enqueueAnew(std::uint32_t row, Entry& entry) {
    entry.looked = false;
    if (!isPutOff(entry)) return urgent_.rank(entry.handle, task(row, entry).worth);
    later_.remove(entry.handle);
    entry.putOff = 0;
    enqueue(row, entry);
}

void OpenWork::open(std::uint32_t row, std::span<const OpenBlock> blocks) {
    if (blocks.empty()) return;
    RowList& list = rows_[row];
    std::vector<Entry> merged;
    merged.reserve(list.open + blocks.size());
    auto old = list.entries.begin();
    for (const OpenBlock& block : blocks) {
        for (; old != list.entries.end() && old->block < block.block; ++old)
            if (old->open) merged.push_back(*old);
        const bool same = old != list.entries.end() && old->block == block.block;
        Entry entry = same ? *old++ : Entry{};
        if (entry.open) {
            const float before = entry.factor;
            entry.anew |= block.anew;
            entry.since = std::min(entry.since, block.since);
            entry.factor = std::max(before, block.factor);
            add(entry.block, double(entry.factor) - double(before), list.power, 0);
            enqueueAnew(row, entry);
        } else {
            entry = {block.anew, block.block, block.since, block.factor, 0, true};
            add(entry.block, entry.factor, list.power, 1);
            ++list.open;
            enqueue(row, entry);
        }
        merged.push_back(entry);
    }
    for (; old != list.entries.end(); ++old)
        if (old->open) merged.push_back(*old);
    list.entries = std::move(merged);
}

void OpenWork::drop(std::uint32_t row) {
    RowList& list = rows_[row];
    for (const Entry& entry : list.entries) {
        if (!entry.open) continue;
        add(entry.block, -double(entry.factor), list.power, -1);
        queueOf(entry).remove(entry.handle);
    }
    list.entries.clear();
    list.open = 0;
}

std::vector<std::uint32_t> OpenWork::urgent(std::uint32_t row, double enough) const {
    std::vector<std::uint32_t> blocks;
    for (const Entry& entry : rows_[row].entries)
        if (entry.open && bound(entry.block) > enough) blocks.push_back(entry.block);
    return blocks;
}

std::vector<OpenWork::AtBlock> OpenWork::atBlocks(double enough) const {
    std::vector<AtBlock> blocks(sums_.size());
    for (const RowList& list : rows_)
        for (const Entry& entry : list.entries) {
            if (!entry.open) continue;
            AtBlock& at = blocks[entry.block];
            ++(bound(entry.block) > enough ? at.rows : at.small);
            const WorkQueue& queue = isPutOff(entry) ? later_ : urgent_;
            at.worth = std::max(at.worth, queue.value(entry.handle));
        }
    return blocks;
}

OpenWork::Entry* OpenWork::find(std::uint32_t row, std::uint32_t block) {
    std::vector<Entry>& entries = rows_[row].entries;
    const auto found =
        std::lower_bound(entries.begin(), entries.end(), block,
                         [](const Entry& entry, std::uint32_t at) { return entry.block < at; });
    return found != entries.end() && found->block == block && found->open ? &*found : nullptr;
}

std::optional<OpenBlock> OpenWork::next(double enough, std::size_t& steps) {
    for (; steps > 0 && pending(enough); --steps) {
        if (urgent_.empty()) {
            std::swap(urgent_, later_);
            ++swaps_; // nothing is put off any more
        }
        const std::optional<WorkQueue::Choice> choice = urgent_.choose(taken_);
        if (!choice) return {};
        const auto row = std::uint32_t(choice->task.id >> 32);
        Entry& entry = *find(row, std::uint32_t(choice->task.id));
        if (enough > 0 && bound(entry.block) <= enough) {
            urgent_.remove(entry.handle);
            entry.putOff = swaps_;
            enqueue(row, entry);
            continue;
        }
        return OpenBlock{row,
                         entry.block,
                         entry.anew,
                         entry.since,
                         entry.factor,
                         !entry.looked && !choice->overdue && order_->looks(),
                         choice->overdue};
    }
    return {};
}

void OpenWork::close(const OpenBlock& block) {
    Entry& entry = *find(block.row, block.block);
    RowList& list = rows_[block.row];
    urgent_.finish({entry.handle, {}, block.overdue});
    add(entry.block, -double(entry.factor), list.power, -1);
    entry.open = false;
    if (--list.open == 0) list.entries.clear();
    taken_ += double(cost(block));
}

void OpenWork::expect(std::uint32_t row, std::uint32_t block, const ExpectedFactor& expected) {
    Entry* const entry = find(row, block);
    if (!entry) return;
    entry->looked = true;
    entry->expected = expected;
    queueOf(*entry).rank(entry->handle, task(row, *entry).worth);
}

void OpenWork::putBack(const OpenBlock& block) {
    const Entry& entry = *find(block.row, block.block);
    queueOf(entry).rank(entry.handle, task(block.row, entry).worth);
}

void OpenWork::learn(const OpenBlock& done, float share) {
    constexpr float kAlike = 0.5f; // as much as the block beside it, that is likely
    if (!order_->learns()) return;
    for (const std::uint32_t beside : {done.block - 1, done.block + 1}) {
        Entry* const entry = find(done.row, beside);
        if (!entry || !entry->looked || entry->expected.share >= kAlike * share) continue;
        entry->expected.share = kAlike * share;
        queueOf(*entry).rank(entry->handle, task(done.row, *entry).worth);
    }
}

std::optional<OpenBlock> OpenWork::take(double enough, std::size_t& steps) {
    const std::optional<OpenBlock> block = next(enough, steps);
    if (block) close(*block);
    return block;
}

} // namespace penumbra
