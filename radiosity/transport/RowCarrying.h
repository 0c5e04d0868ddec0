// Rows of the shadow-form-factor-list from one meshing to the next.
#pragma once

#include "radiosity/rows/EntryCarrier.h"
#include "radiosity/rows/RowTable.h"
#include "radiosity/schedule/RowUpdates.h"
#include "radiosity/transport/PatchMatch.h"

#include <cstdint>
#include <span>
#include <vector>

namespace penumbra {

/// Carries rows over to another meshing, on several threads if need be, and says which of their
/// entries are to be evaluated anew. What changed in between is then an edit like any other: see
/// unknown() and PatchMatch::changed, which go to RowUpdates::add().
class RowCarrying {
public:
    /// \param receivers PatchMatch::vertices or nodes. All must outlive this.
    RowCarrying(const PatchSet& now, const PatchMatch& match,
                std::span<const std::uint32_t> receivers);

    /// A row and what it was called.
    struct Place {
        std::uint32_t row = 0, was = 0;
    };
    /// Whether a block has the receivers of one that was there before, in the same order.
    bool isWhole(std::uint32_t block) const { return whole_[block] != PatchMatch::kNew; }
    /// Which one. \pre isWhole(block)
    std::uint32_t wasBlock(std::uint32_t block) const { return whole_[block]; }
    EntryCarrier carrier() const { return EntryCarrier(match_.objects); }
    /// Fills the blocks that a row has.
    /// \param before, pending the rows before, which are used up, and what was dirty of them
    /// \param carrier one a thread
    /// \return entries to be evaluated anew, besides those of receivers that are new
    std::vector<BlockMask> carry(Place place, RowTable& before, const DirtySet& pending,
                                 EntryCarrier& carrier, RowTable& now) const;

    /// Who hid blocks that are whole, from a sender. \param were by block, as RowTable has them
    std::vector<RowTable::BlockerNote>
    occluders(std::uint32_t row, std::span<const RowTable::BlockerNote> were, const Row& now) const;
    /// Receivers of the other blocks of a row that were in a block of which there is such a note.
    std::vector<BlockMask> partlyHidden(std::span<const RowTable::BlockerNote> were,
                                        const Row& now) const;

    /// Receivers that were not there before.
    std::vector<BlockMask> unknown() const;

private:
    std::uint64_t take(std::uint32_t block, Row& before, EntryCarrier& carrier,
                       RowBlock& now) const;

    const PatchMatch& match_;
    std::span<const std::uint32_t> receivers_;
    std::vector<std::uint8_t> changed_; ///< likewise: it is not what it was
    std::vector<std::uint32_t> whole_;  ///< one a block: that which it was, or kNew
    std::vector<std::uint64_t> known_;  ///< one a block, bits: receivers that were there before
    std::vector<std::uint8_t> uses_;    ///< one a block before: 2 if several are made of it
};

} // namespace penumbra
