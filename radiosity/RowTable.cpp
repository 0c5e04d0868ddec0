#include "radiosity/RowTable.h"

#include "radiosity/Shaft.h"

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

void RowTable::listBlockers(const PatchSet& set, std::uint32_t row, std::uint32_t block,
                            const RowBlock& entries, std::vector<BlockerNote>& notes) {
    entries.forEachBlocker([&](std::uint32_t object) {
        if (set.objects[object].movable) notes.push_back({row, block, object});
    });
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
                                           const PendingChange& change) const {
    std::vector<BlockMask> masks;
    const Row& entries = rows_[row];
    if (change.moves(object.value)) {
        for (std::size_t i = 0; i < entries.size(); ++i)
            masks.push_back({entries.blockAt(i), ~std::uint64_t(0)});
        return masks;
    }
    for (const BlockMask& mask : change.receivers)
        if (entries.has(mask.block)) masks.push_back(mask);
    const std::vector<std::uint64_t>& list = blockers_[row];
    for (const MovedObject& m : change.moved) {
        const std::uint64_t first = std::uint64_t(m.object) << 32;
        for (auto key = std::lower_bound(list.begin(), list.end(), first);
             key != list.end() && *key >> 32 == m.object; ++key)
            masks.push_back({std::uint32_t(*key), 0});
        if (m.present) crossed(entries, sender, m.box, 0, masks);
    }
    for (const Bounds& region : change.regions)
        crossed(entries, sender, region, ~std::uint64_t(0), masks);
    unite(masks);
    return masks;
}

/// Adds the blocks of a row whose shafts meet a box.
void RowTable::crossed(const Row& row, const Bounds& sender, const Bounds& box,
                       std::uint64_t receivers, std::vector<BlockMask>& masks) const {
    constexpr std::size_t kFew = 32; // are looked at one by one
    const auto meets = [&](const Bounds& block) { return shaftMeets(sender, block, box); };
    if (row.size() <= kFew) {
        for (std::size_t i = 0; i < row.size(); ++i)
            if (const std::uint32_t b = row.blockAt(i); !blocks_[b].empty() && meets(blocks_[b]))
                masks.push_back({b, receivers});
        return;
    }
    blocks_.query([&](std::size_t n) { return meets(blocks_.node(n)); },
                  [&](std::size_t b) {
                      if (row.has(std::uint32_t(b))) masks.push_back({std::uint32_t(b), receivers});
                  });
}

} // namespace penumbra
