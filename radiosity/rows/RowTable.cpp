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

void RowTable::noteAll(std::uint32_t row, std::span<const BlockerNote> notes) {
    std::vector<std::uint64_t>& list = blockers_[row];
    for (const auto& note : notes) list.push_back(std::uint64_t(note.object) << 32 | note.block);
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
}

void RowTable::note(std::span<const BlockerNote> notes) {
    for (const auto& [row, block, object] : notes) {
        std::vector<std::uint64_t>& list = blockers_[row];
        const std::uint64_t key = std::uint64_t(object) << 32 | block;
        const auto place = std::lower_bound(list.begin(), list.end(), key);
        if (place == list.end() || *place != key) list.insert(place, key);
    }
}

std::vector<BlockMask> RowTable::concerned(std::size_t row, const Bounds& sender, ObjectId object,
                                           const PendingChange& change, Blocks blocks) const {
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
    const std::vector<std::uint64_t>& list = blockers_[row];
    for (const MovedObject& m : change.moved) {
        const std::uint64_t first = std::uint64_t(m.object) << 32 | blocks.first;
        for (auto key = std::lower_bound(list.begin(), list.end(), first);
             key != list.end() && *key >> 32 == m.object && isOne(std::uint32_t(*key)); ++key)
            masks.push_back({std::uint32_t(*key), 0});
        if (m.present) crossed(entries, blocks, sender, m.box, 0, masks);
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
