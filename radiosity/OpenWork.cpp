#include "radiosity/OpenWork.h"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

namespace penumbra {

namespace {

/// See setPatience(): until it is told how fast work is done.
constexpr WorkQueue::Fairness kFairness{.patience = 4e6, .reserve = 0.25};

} // namespace

OpenWork::OpenWork(std::size_t rows, const Costs& costs)
    : rows_(rows), costs_(costs), queue_(kFairness) {
    setOrder(std::make_shared<const BoundOrder>());
}

std::size_t OpenWork::cost(const OpenBlock& block) const {
    return costs_.visit + costs_.entry * std::size_t(std::popcount(block.anew));
}

void OpenWork::setOrder(std::shared_ptr<const OrderOfWork> order) {
    order_ = std::move(order);
    queue_ = WorkQueue(kFairness);
    setPatience(patience_);
    rekey();
    for (std::uint32_t row = 0; row < rows_.size(); ++row) {
        for (Entry& entry : rows_[row].entries) {
            entry.handle = kPutOff;
            if (!entry.open) continue;
            if (!order_->looks()) forget(entry);
            if (entry.prospect) entry.prospect->unrank();
        }
        setUnsorted(row);
    }
}

void OpenWork::rekey() {
    queue_.rekey([order = order_](std::uint32_t place) { return order->value(place); });
}

void OpenWork::setPatience(double rays) {
    patience_ = rays;
    queue_.setPatience(rays);
}

void OpenWork::setWhole(bool whole) {
    if (std::exchange(whole_, whole) == whole) return;
    for (std::uint32_t row = 0; row < rows_.size(); ++row)
        for (Entry& entry : rows_[row].entries)
            if (entry.open && entry.handle != kPutOff)
                queue_.rank(entry.handle, worthOf(row, entry));
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

/// About [rays].
double OpenWork::costOf(const Entry& entry, std::uint64_t receivers) const {
    if (!entry.prospect) return double(cost({0, entry.block, entry.anew & receivers, 0, 0}));
    return entry.prospect->cost(receivers);
}

WorkQueue::Task OpenWork::task(std::uint32_t row, const Entry& entry) const {
    const Receivers& r = receivers_[entry.block];
    const double bound =
        double(r.reflectance) * double(entry.factor) * (rows_[row].power + double(r.light));
    const OpenBlock block{row, entry.block, entry.anew, entry.since, entry.factor};
    // A look may find that all the change is in a few receivers.
    const double expense = order_->looks() ? double(kVisitCost) : double(cost(block));
    WorkQueue::Task task = order_->rank({row, entry.block, bound, expense});
    task.since = taken_;
    return task;
}

/// Of a block that was looked at: which of the receivers that are left come next, and what that is
/// worth.
WorkQueue::Worth OpenWork::choosePart(std::uint32_t row, Entry& entry) {
    if (!entry.prospect->isRanked(order_->view())) rankReceivers(row, entry);
    const std::uint32_t place = task(row, entry).place;
    // Where nobody looks, visits are dearer than what comes a little sooner is worth.
    const Prospect::Part part = entry.prospect->bestPart(whole_ || !queue_.inPicture(place));
    entry.part = part.receivers;
    return queue_.worthOf(place, part.gain, part.cost);
}

void OpenWork::rankReceivers(std::uint32_t row, Entry& entry) {
    const Receivers& r = receivers_[entry.block];
    const ExpectedFactors& expected = entry.prospect->expected();
    std::array<float, ExpectedFactors::kSize> change, gains;
    change.fill(0); // what is done is not asked for
    for (std::uint64_t left = entry.left; left != 0; left &= left - 1) {
        const auto i = std::size_t(std::countr_zero(left));
        change[i] = float(double(r.reflectance) * double(expected.factor[i]) *
                          (rows_[row].power + double(r.light)));
    }
    order_->gains({row, entry.block, 0, 0}, change, gains);
    entry.prospect->rank(entry.left, gains, order_->view());
}

WorkQueue::Worth OpenWork::worthOf(std::uint32_t row, Entry& entry) {
    return entry.prospect ? choosePart(row, entry) : task(row, entry).worth;
}

/// What was expected of a block.
void OpenWork::forget(Entry& entry) {
    entry.prospect.reset();
    entry.part = entry.left;
}

void OpenWork::enqueue(std::uint32_t row, Entry& entry) {
    WorkQueue::Task one = task(row, entry);
    one.id = idOf(row, std::size_t(&entry - rows_[row].entries.data()));
    entry.handle = queue_.add(one);
    if (entry.prospect) queue_.rank(entry.handle, choosePart(row, entry));
}

void OpenWork::putOff(Entry& entry) {
    if (const WorkQueue::Handle handle = std::exchange(entry.handle, kPutOff); handle != kPutOff)
        queue_.remove(handle);
}

/// There is more to it now. What is not put off keeps its age.
void OpenWork::openAnew(std::uint32_t row, Entry& entry) {
    entry.left = ~std::uint64_t(0);
    forget(entry);
    if (entry.handle != kPutOff) queue_.rank(entry.handle, task(row, entry).worth);
}

void OpenWork::setUnsorted(std::uint32_t row) {
    RowList& list = rows_[row];
    if (list.open > 0 && !std::exchange(list.unsorted, true)) unsorted_.push_back(row);
}

/// Puts into the queue what belongs there; false: no step is left for it.
bool OpenWork::sort(double enough, std::size_t& steps) {
    for (; !unsorted_.empty() && steps > 0; unsorted_.pop_front()) {
        constexpr std::size_t kAtOnce = 8; // looked at in the time of a step
        RowList& list = rows_[unsorted_.front()];
        list.unsorted = false;
        std::size_t queued = 0;
        for (Entry& entry : list.entries) {
            if (!entry.open || entry.handle != kPutOff) continue;
            if (enough > 0 && bound(entry.block) <= enough) continue;
            enqueue(unsorted_.front(), entry);
            ++queued;
        }
        steps -= std::min(steps, 1 + queued + list.entries.size() / kAtOnce);
    }
    return unsorted_.empty();
}

void OpenWork::open(std::uint32_t row, std::span<const OpenBlock> blocks) {
    if (blocks.empty()) return;
    RowList& list = rows_[row];
    std::vector<Entry> merged;
    merged.reserve(list.open + blocks.size());
    auto old = list.entries.begin();
    for (const OpenBlock& block : blocks) {
        for (; old != list.entries.end() && old->block < block.block; ++old)
            if (old->open) merged.push_back(std::move(*old));
        const bool same = old != list.entries.end() && old->block == block.block;
        Entry entry = same ? std::move(*old++) : Entry{};
        if (entry.open) {
            const float before = entry.factor;
            entry.anew |= block.anew;
            entry.since = std::min(entry.since, block.since);
            entry.factor = std::max(before, block.factor);
            add(entry.block, double(entry.factor) - double(before), list.power, 0);
            openAnew(row, entry);
        } else {
            entry = {block.anew, block.block, block.since, block.factor};
            entry.open = true;
            add(entry.block, entry.factor, list.power, 1);
            ++list.open;
        }
        merged.push_back(std::move(entry));
    }
    for (; old != list.entries.end(); ++old)
        if (old->open) merged.push_back(std::move(*old));
    list.entries = std::move(merged);
    for (std::size_t e = 0; e < list.entries.size(); ++e)
        if (list.entries[e].handle != kPutOff) queue_.setId(list.entries[e].handle, idOf(row, e));
    setUnsorted(row);
}

void OpenWork::drop(std::uint32_t row) {
    RowList& list = rows_[row];
    for (Entry& entry : list.entries) {
        if (!entry.open) continue;
        add(entry.block, -double(entry.factor), list.power, -1);
        putOff(entry);
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
    for (std::uint32_t row = 0; row < rows_.size(); ++row)
        for (const Entry& entry : rows_[row].entries) {
            if (!entry.open) continue;
            AtBlock& at = blocks[entry.block];
            ++(bound(entry.block) > enough ? at.rows : at.small);
            at.worth = std::max(at.worth, entry.handle != kPutOff ? queue_.value(entry.handle)
                                                                  : queue_.value(task(row, entry)));
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
        if (queue_.empty() && unsorted_.empty()) // nothing is put off any more
            for (std::uint32_t row = 0; row < rows_.size(); ++row) setUnsorted(row);
        if (!sort(enough, steps)) return {};
        const std::optional<WorkQueue::Choice> choice = queue_.choose(taken_);
        if (!choice) return {};
        const auto row = std::uint32_t(choice->task.id >> 32);
        const auto at = std::uint32_t(choice->task.id);
        Entry& entry = rows_[row].entries[at];
        if (enough > 0 && bound(entry.block) <= enough) {
            putOff(entry);
            continue;
        }
        const bool looks = !choice->overdue && order_->looks();
        if (looks && entry.prospect &&
            !entry.prospect->isRanked(order_->view())) { // the viewer has moved
            queue_.rank(entry.handle, choosePart(row, entry));
            continue;
        }
        const std::uint64_t receivers = choice->overdue ? entry.left : entry.part;
        return OpenBlock{row,
                         entry.block,
                         entry.anew & receivers,
                         entry.since,
                         entry.factor,
                         receivers,
                         costOf(entry, receivers),
                         looks && !entry.prospect,
                         choice->overdue,
                         at};
    }
    return {};
}

void OpenWork::close(const OpenBlock& block) {
    Entry& entry = rows_[block.row].entries[block.entry];
    const WorkQueue::Choice choice{entry.handle, {}, block.overdue};
    taken_ += block.cost;
    entry.left &= ~block.receivers;
    entry.anew &= ~block.receivers;
    if (entry.left != 0) {
        entry.prospect->close(block.receivers);
        return queue_.finishPart(choice, block.cost, worthOf(block.row, entry));
    }
    queue_.finish(choice, block.cost);
    entry.handle = kPutOff;
    finish(block.row, entry);
}

/// Of what is not in the queue.
void OpenWork::finish(std::uint32_t row, Entry& entry) {
    RowList& list = rows_[row];
    add(entry.block, -double(entry.factor), list.power, -1);
    entry.open = false;
    entry.prospect.reset();
    if (--list.open == 0) list.entries.clear();
}

/// Whether any of it is still open.
bool OpenWork::narrow(std::uint32_t row, Entry& entry, std::uint64_t receivers) {
    entry.left &= receivers;
    if (entry.left != 0) return true;
    putOff(entry);
    finish(row, entry);
    return false;
}

void OpenWork::narrow(std::uint32_t row, std::uint32_t block, std::uint64_t receivers) {
    Entry* const entry = find(row, block);
    if (!entry || !narrow(row, *entry, receivers)) return;
    forget(*entry);
    entry->anew &= receivers;
    if (entry->handle != kPutOff) queue_.rank(entry->handle, task(row, *entry).worth);
}

void OpenWork::expect(std::uint32_t row, std::uint32_t block, const ExpectedFactors& expected) {
    Entry* const entry = find(row, block);
    if (!entry || !narrow(row, *entry, expected.open)) return;
    entry->prospect = std::make_unique<Prospect>(expected);
    if (entry->handle != kPutOff) queue_.rank(entry->handle, choosePart(row, *entry));
}

void OpenWork::putBack(const OpenBlock& block) {
    Entry& entry = rows_[block.row].entries[block.entry];
    queue_.rank(entry.handle, worthOf(block.row, entry));
}

std::optional<OpenBlock> OpenWork::take(double enough, std::size_t& steps) {
    const std::optional<OpenBlock> block = next(enough, steps);
    if (block) close(*block);
    return block;
}

} // namespace penumbra
