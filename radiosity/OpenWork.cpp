#include "radiosity/OpenWork.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace penumbra {

namespace {

/// Quarters of octaves, 2^-40 the lowest: exponent and first two bits of the fraction.
std::size_t stepOf(double worth, std::size_t steps) {
    constexpr std::uint32_t kLowest = (127 - 40) << 2;
    const std::uint32_t step = std::bit_cast<std::uint32_t>(float(worth)) >> 21;
    return std::min<std::size_t>(step > kLowest ? step - kLowest : 0, steps - 1);
}

} // namespace

void OpenWork::Queue::push(std::size_t step, const Place& place) {
    steps[step].push_back(place);
    ++size;
    top = std::max(top, step);
}

std::size_t OpenWork::Queue::pop(Place& place) {
    while (next[top] == steps[top].size()) --top;
    const std::size_t step = top;
    place = steps[step][next[step]++];
    --size;
    if (next[step] == steps[step].size()) steps[step].clear(), next[step] = 0;
    return step;
}

OpenWork::OpenWork(std::size_t rows, std::size_t visitCost)
    : rows_(rows), visitCost_(visitCost),
      worth_([](const OpenBlock&, double bound, double cost) { return bound / cost; }) {}

std::size_t OpenWork::cost(const OpenBlock& block) const {
    constexpr std::size_t kSamples = 20; // of an entry that is evaluated anew
    return visitCost_ + kSamples * std::size_t(std::popcount(block.anew));
}

void OpenWork::setWorth(Worth worth) {
    worth_ = std::move(worth);
    urgent_ = {}, later_ = {};
    for (std::uint32_t row = 0; row < rows_.size(); ++row)
        for (Entry& entry : rows_[row].entries)
            if (entry.ticket != 0) enqueue(row, entry);
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
    entry.ticket = ++tickets_ == 0 ? ++tickets_ : tickets_;
    urgent_.push(stepOf(worth_(block, bound, double(cost(block))), kSteps),
                 {row, entry.block, entry.ticket});
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

OpenWork::Entry* OpenWork::find(const Place& place) {
    std::vector<Entry>& entries = rows_[place.row].entries;
    const auto found = std::lower_bound(
        entries.begin(), entries.end(), place.block,
        [](const Entry& entry, std::uint32_t block) { return entry.block < block; });
    const bool same =
        found != entries.end() && found->block == place.block && found->ticket == place.ticket;
    return same ? &*found : nullptr;
}

std::optional<OpenBlock> OpenWork::take(double enough, std::size_t& steps) {
    for (; steps > 0 && pending(enough); --steps) {
        if (urgent_.size == 0) std::swap(urgent_, later_);
        Place place{};
        const std::size_t step = urgent_.pop(place);
        Entry* const entry = find(place);
        if (!entry) continue;
        if (enough > 0 && bound(entry->block) <= enough) {
            later_.push(step, place);
            continue;
        }
        RowList& list = rows_[place.row];
        const OpenBlock taken{place.row, entry->block, entry->anew, entry->since, entry->factor};
        add(entry->block, -double(entry->factor), list.power, -1);
        entry->ticket = 0;
        if (--list.open == 0) list.entries.clear();
        if (count_ == 0) urgent_ = {}, later_ = {}; // places that count for nothing
        return taken;
    }
    return {};
}

} // namespace penumbra
