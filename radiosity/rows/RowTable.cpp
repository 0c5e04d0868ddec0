#include "radiosity/rows/RowTable.h"

#include "radiosity/rays/Shaft.h"

#include <algorithm>

namespace penumbra {

void unite(std::vector<BlockMask>& masks) {
    std::sort(masks.begin(), masks.end(),
              [](const BlockMask& a, const BlockMask& b) { return a.block < b.block; });
    std::size_t count = 0;
    for (const BlockMask& mask : masks) {
        if (count > 0 && masks[count - 1].block == mask.block)
            masks[count - 1].receivers |= mask.receivers;
        else
            masks[count++] = mask;
    }
    masks.resize(count);
}

bool PendingChange::moves(std::uint32_t object) const {
    return std::any_of(moved.begin(), moved.end(),
                       [&](const MovedObject& m) { return m.object == object; });
}

void RowTable::listBlockers(std::uint32_t row, std::uint32_t block, const RowBlock& entries,
                            std::vector<BlockerNote>& notes) {
    entries.forEachBlocker([&](std::uint32_t object) { notes.push_back({row, block, object}); });
}

/// Run by run of the same row. Most are known: few that are not go to their places one by one.
void RowTable::insert(std::vector<Keys>& lists, std::span<const BlockerNote> notes) {
    constexpr std::size_t kFew = 8;
    Keys fresh;
    for (std::size_t first = 0, end = 0; first < notes.size(); first = end) {
        const std::uint32_t row = notes[first].row;
        while (end < notes.size() && notes[end].row == row) ++end;
        Keys& list = lists[row];
        fresh.clear();
        for (const auto& note : notes.subspan(first, end - first)) {
            const std::uint64_t key = std::uint64_t(note.object) << 32 | note.block;
            if (!std::binary_search(list.begin(), list.end(), key)) fresh.push_back(key);
        }
        std::sort(fresh.begin(), fresh.end());
        fresh.erase(std::unique(fresh.begin(), fresh.end()), fresh.end());
        if (fresh.size() <= kFew) {
            for (const std::uint64_t key : fresh)
                list.insert(std::upper_bound(list.begin(), list.end(), key), key);
        } else {
            const auto known = std::ptrdiff_t(list.size());
            list.insert(list.end(), fresh.begin(), fresh.end());
            std::inplace_merge(list.begin(), list.begin() + known, list.end());
        }
    }
}

std::vector<RowTable::BlockerNote> RowTable::occluders(std::uint32_t row) const {
    std::vector<BlockerNote> notes;
    for (const std::uint64_t key : occluders_[row])
        notes.push_back({row, std::uint32_t(key), std::uint32_t(key >> 32)});
    std::stable_sort(notes.begin(), notes.end(),
                     [](const BlockerNote& a, const BlockerNote& b) { return a.block < b.block; });
    return notes;
}

/// Calls visit(block) for those of some blocks at which a list has an object.
template <class Visit>
void RowTable::forEachOf(const Keys& list, std::uint32_t object, Blocks blocks, Visit visit) {
    const std::uint64_t first = std::uint64_t(object) << 32 | blocks.first;
    for (auto key = std::lower_bound(list.begin(), list.end(), first);
         key != list.end() && *key >> 32 == object && std::uint32_t(*key) < blocks.end; ++key)
        visit(std::uint32_t(*key));
}

void RowTable::forgetOccluders(std::size_t row, ObjectId object, const PendingChange& change,
                               Blocks blocks) {
    Keys& list = occluders_[row];
    if (change.moves(object.value)) {
        std::erase_if(list, [&](std::uint64_t key) {
            return std::uint32_t(key) >= blocks.first && std::uint32_t(key) < blocks.end;
        });
        return;
    }
    for (const MovedObject& m : change.moved) {
        const std::uint64_t at = std::uint64_t(m.object) << 32;
        const auto first = std::lower_bound(list.begin(), list.end(), at | blocks.first);
        list.erase(first, std::lower_bound(first, list.end(), at | blocks.end));
    }
}

std::vector<BlockMask> RowTable::concerned(std::size_t row, const Bounds& sender, ObjectId object,
                                           const PendingChange& change, Blocks blocks,
                                           const Hiding& hidden) const {
    std::vector<BlockMask> masks;
    const Row& entries = rows_[row];
    const auto isOne = [&](std::uint32_t b) { return b >= blocks.first && b < blocks.end; };
    if (change.moves(object.value)) {
        for (std::size_t i = 0; i < entries.size(); ++i)
            if (const std::uint32_t b = entries.blockAt(i); isOne(b))
                masks.push_back({b, ~std::uint64_t(0)});
        return masks;
    }
    const auto anew = std::lower_bound(
        change.receivers.begin(), change.receivers.end(), blocks.first,
        [](const BlockMask& mask, std::uint32_t first) { return mask.block < first; });
    for (auto mask = anew; mask != change.receivers.end() && mask->block < blocks.end; ++mask)
        if (entries.has(mask->block)) masks.push_back(*mask);
    // Its own faces may stand before all of its box, but what it hides changes.
    const auto isBehindOthers = [&](const MovedObject& m) {
        const ObjectId by = hidden ? hidden(m.box) : ObjectId();
        return by.valid() && by.value != m.object;
    };
    for (const MovedObject& m : change.moved) {
        forEachOf(blockers_[row], m.object, blocks, [&](std::uint32_t b) {
            masks.push_back({b, 0});
        });
        forEachOf(occluders_[row], m.object, blocks, [&](std::uint32_t b) {
            if (entries.has(b)) masks.push_back({b, ~entries[b].present()});
        });
        if (m.present && !isBehindOthers(m)) crossed(entries, blocks, sender, m.box, 0, masks);
    }
    for (const Bounds& region : change.regions)
        crossed(entries, blocks, sender, region, ~std::uint64_t(0), masks);
    unite(masks);
    return masks;
}

/// Adds those of some blocks whose shafts meet a box.
void RowTable::crossed(const Row& row, Blocks blocks, const Bounds& sender, const Bounds& box,
                       std::uint64_t receivers, std::vector<BlockMask>& masks) const {
    constexpr std::size_t kFew = 32; // are tested one by one
    const auto meets = [&](const Bounds& block) { return shaftMeets(sender, block, box); };
    if (row.size() <= kFew) {
        for (std::size_t i = 0; i < row.size(); ++i) {
            const std::uint32_t b = row.blockAt(i);
            if (b < blocks.first || b >= blocks.end || blocks_[b].empty()) continue;
            if (meets(blocks_[b])) masks.push_back({b, receivers});
        }
        return;
    }
    blocks_.query(
        blocks.first, blocks.end, [&](std::size_t n) { return meets(blocks_.node(n)); },
        [&](std::size_t b) {
            if (row.has(std::uint32_t(b))) masks.push_back({std::uint32_t(b), receivers});
        });
}

} // namespace penumbra
