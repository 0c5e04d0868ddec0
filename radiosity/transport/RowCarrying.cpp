#include "radiosity/transport/RowCarrying.h"

#include "radiosity/rays/Margins.h"
#include "radiosity/rays/Shaft.h"

#include <algorithm>

namespace penumbra {

namespace {

constexpr std::uint32_t kBlock = PatchSet::kBlock;

/// Bits: those of some receivers that were there before.
std::uint64_t knownOf(std::span<const std::uint32_t> receivers) {
    std::uint64_t known = 0;
    for (std::size_t r = 0; r < receivers.size(); ++r)
        known |= std::uint64_t(receivers[r] != PatchMatch::kNew) << r;
    return known;
}

/// Whether these were a block, in the same order.
bool areBlock(std::span<const std::uint32_t> receivers) {
    std::uint32_t next = receivers[0];
    return next != PatchMatch::kNew && next % kBlock == 0 &&
           std::ranges::all_of(receivers, [&](std::uint32_t r) { return r == next++; });
}

/// Bits: those that were in one of some blocks. \param blocks ascending
std::uint64_t amongBlocks(std::span<const std::uint32_t> receivers,
                          const std::vector<std::uint32_t>& blocks) {
    std::uint64_t among = 0;
    for (std::size_t r = 0; r < receivers.size() && !blocks.empty(); ++r)
        if (receivers[r] != PatchMatch::kNew &&
            std::binary_search(blocks.begin(), blocks.end(), receivers[r] / kBlock))
            among |= std::uint64_t(1) << r;
    return among;
}

} // namespace

RowCarrying::RowCarrying(const PatchSet& now, const PatchMatch& match,
                         std::span<const std::uint32_t> receivers)
    : match_(match), receivers_(receivers), changed_(now.objects.size()) {
    for (const ObjectId object : match.changed) changed_[object.value] = 1;
    for (std::uint32_t b = 0; b < receivers.size() / kBlock; ++b) {
        const auto from = receivers.subspan(b * kBlock, kBlock);
        whole_.push_back(areBlock(from) ? from[0] / kBlock : PatchMatch::kNew);
        known_.push_back(knownOf(from));
        std::uint32_t last = PatchMatch::kNew;
        for (const std::uint32_t f : from) {
            if (f == PatchMatch::kNew || f / kBlock == last) continue;
            last = f / kBlock;
            if (last >= uses_.size()) uses_.resize(last + 1);
            uses_[last] = std::uint8_t(std::min(uses_[last] + 1, 2));
        }
    }
}

/// \return bits: receivers of which it is known whether they have an entry
std::uint64_t RowCarrying::take(std::uint32_t block, Row& before, EntryCarrier& carrier,
                                RowBlock& now) const {
    if (!isWhole(block))
        return carrier.carry(before, receivers_.subspan(block * kBlock, kBlock), now);
    const std::uint32_t was = whole_[block];
    if (!before.has(was)) return 0;
    now = carrier.whole(uses_[was] == 1 ? std::move(before[was]) : before[was].copy());
    return ~std::uint64_t(0);
}

std::vector<BlockMask> RowCarrying::carry(Place place, RowTable& before, const DirtySet& pending,
                                          EntryCarrier& carrier, RowTable& now) const {
    const std::vector<std::uint32_t> dirty = pending.urgent(place.was, -1);
    std::vector<BlockMask> anew;
    std::vector<RowTable::BlockerNote> notes;
    Row& row = now[place.row];
    for (std::size_t i = 0; i < row.size(); ++i) {
        const std::uint32_t b = row.blockAt(i);
        const auto from = receivers_.subspan(b * kBlock, kBlock);
        RowBlock& block = row.begin()[std::ptrdiff_t(i)];
        const std::uint64_t known = take(b, before[place.was], carrier, block);
        std::uint64_t again = known_[b] & ~known;
        if (!dirty.empty()) again |= amongBlocks(from, dirty);
        if (again != 0) anew.push_back({b, again});
        block.forEachBlocker([&](std::uint32_t object) {
            notes.push_back({place.row, b, object});
        });
    }
    now.note(notes);
    before[place.was].clear();
    return anew;
}

std::vector<RowTable::BlockerNote>
RowCarrying::occluders(std::uint32_t row, std::span<const RowTable::BlockerNote> were,
                       const Row& now) const {
    std::vector<RowTable::BlockerNote> notes;
    for (std::size_t i = 0; i < now.size(); ++i) {
        const std::uint32_t b = now.blockAt(i);
        if (!isWhole(b)) continue;
        auto note = std::ranges::lower_bound(were, whole_[b], {}, &RowTable::BlockerNote::block);
        for (; note != were.end() && note->block == whole_[b]; ++note)
            notes.push_back({row, b, match_.objects[note->object]});
    }
    return notes;
}

std::vector<BlockMask> RowCarrying::partlyHidden(std::span<const RowTable::BlockerNote> were,
                                                 const Row& now) const {
    std::vector<std::uint32_t> hidden;
    for (const auto& note : were) hidden.push_back(note.block);
    std::vector<BlockMask> masks;
    for (std::size_t i = 0; i < now.size() && !hidden.empty(); ++i) {
        const std::uint32_t b = now.blockAt(i);
        if (isWhole(b)) continue;
        const auto bits = amongBlocks(receivers_.subspan(b * kBlock, kBlock), hidden);
        if (bits != 0) masks.push_back({b, bits});
    }
    return masks;
}

std::vector<BlockMask> RowCarrying::unknown() const {
    std::vector<BlockMask> masks;
    for (std::uint32_t b = 0; b < receivers_.size() / kBlock; ++b)
        if (~known_[b] != 0) masks.push_back({b, ~known_[b]});
    return masks;
}

} // namespace penumbra
