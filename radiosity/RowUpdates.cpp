#include "radiosity/RowUpdates.h"

#include "radiosity/Parallel.h"
#include "radiosity/Shaft.h"

#include <algorithm>

namespace penumbra {

namespace {

constexpr std::size_t kSamples = 20; ///< rays of an entry that is evaluated anew, about

} // namespace

RowUpdates::RowUpdates(const PatchSet& set, const RayScene& rays, RowTable& table,
                       std::size_t visitCost)
    : set_(set), rayScene_(rays), table_(table), visitCost_(visitCost),
      grain_(std::max<std::size_t>(1, 256 / visitCost)), row_(table.size()) {}

std::size_t RowUpdates::effortOf(const UpdateItem& item) const {
    return visitCost_ + kSamples * std::size_t(std::popcount(item.anew));
}

void RowUpdates::add(std::vector<ObjectId> objects, std::vector<BlockMask> receivers,
                     std::vector<Bounds> regions) {
    unite(receivers);
    edits_.push_back({std::move(objects), std::move(receivers), std::move(regions)});
    change_.reset();
    row_ = 0;
}

/// Rows are mostly up to the same edit: the last answer is kept.
std::shared_ptr<const PendingChange> RowUpdates::changeSince(std::uint64_t edits) {
    if (change_ && changeFrom_ == edits) return change_;
    auto change = std::make_shared<PendingChange>();
    for (std::size_t i = edits - forgotten_; i < edits_.size(); ++i) {
        change->receivers.insert(change->receivers.end(), edits_[i].receivers.begin(),
                                 edits_[i].receivers.end());
        change->regions.insert(change->regions.end(), edits_[i].regions.begin(),
                               edits_[i].regions.end());
        for (ObjectId object : edits_[i].objects) {
            if (change->moves(object.value)) continue;
            MovedObject moved{object.value, set_.objects[object.value].present, {}};
            moved.box = grown(boundsOf(set_, object), 1e-5f * set_.extent);
            change->moved.push_back(moved);
        }
    }
    unite(change->receivers);
    change_ = std::move(change);
    changeFrom_ = edits;
    return change_;
}

void RowUpdates::find(std::size_t effort, const Facts& facts) {
    if (next_ == items_.size()) items_.clear(), next_ = 0;
    std::size_t found = 0;
    for (std::size_t i = next_; i < items_.size() && found < effort; ++i)
        found += effortOf(items_[i]);
    for (; row_ < table_.size() && found < effort; ++row_) {
        std::uint64_t& known = table_.edits(row_);
        if (known == forgotten_ + edits_.size()) continue;
        const RowFacts row = facts(std::uint32_t(row_));
        if (row.known) {
            const auto change = changeSince(known);
            found += 16; // looking for it costs as well
            for (const BlockMask& mask : table_.concerned(row_, row.box, row.object, *change)) {
                items_.push_back({std::uint32_t(row_), mask.block, mask.receivers, change});
                found += effortOf(items_.back());
            }
        }
        known = forgotten_ + edits_.size();
    }
    if (row_ == table_.size()) { // all rows have been told
        forgotten_ += edits_.size();
        edits_.clear();
        change_.reset();
    }
}

std::span<const UpdateItem> RowUpdates::work(std::size_t effort, const Facts& facts,
                                             const Update& update) {
    find(effort, facts);
    std::size_t last = next_;
    for (std::size_t sum = 0; last < items_.size() && sum < effort; ++last)
        sum += effortOf(items_[last]);
    const auto items = std::span<const UpdateItem>(items_).subspan(next_, last - next_);
    const std::size_t tasks = (items.size() + grain_ - 1) / grain_;
    while (builders_.size() < std::min<std::size_t>(tasks, 64)) builders_.emplace_back(rayScene_);
    // A builder a task of a round: results do not depend on which thread does what.
    for (std::size_t round = 0; round < tasks; round += builders_.size()) {
        const std::size_t first = round * grain_;
        const std::size_t count = std::min(items.size() - first, builders_.size() * grain_);
        std::vector<std::uint64_t> changed(builders_.size());
        std::vector<std::vector<RowTable::BlockerNote>> notes(builders_.size());
        parallelFor(count, grain_, [&](std::size_t begin, std::size_t end) {
            RowBuilder& builder = builders_[begin / grain_];
            for (std::size_t i = begin; i < end; ++i) {
                const UpdateItem& item = items[first + i];
                const int entries = update(builder, item, first + i);
                if (entries == 0) continue;
                changed[begin / grain_] += std::uint64_t(entries);
                RowTable::listBlockers(set_, item.row, item.block, table_[item.row][item.block],
                                       notes[begin / grain_]);
            }
        });
        for (std::uint64_t n : changed) entriesChanged_ += n;
        for (const auto& some : notes) table_.note(some);
    }
    for (RowBuilder& builder : builders_) rays_ += builder.takeRayCount();
    blocksVisited_ += items.size();
    next_ = last;
    return items;
}

} // namespace penumbra
