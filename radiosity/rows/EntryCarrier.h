// Entries that were found when the scene was meshed otherwise.
#pragma once

#include "radiosity/rows/Row.h"

#include <cstdint>
#include <span>
#include <vector>

namespace penumbra {

/// Puts blocks of a row together from those of a row of the same sender, when receivers are in
/// other blocks, and objects are called otherwise, than before. An entry is a matter of its sender,
/// its receiver and what is between them: it does not know its neighbours. One a thread, for it
/// owns scratch space.
class EntryCarrier {
public:
    static constexpr std::uint32_t kNew = 0xffffffffu;

    /// \param objects what each object that blocks anything is called now, by its number before
    explicit EntryCarrier(std::span<const std::uint32_t> objects);

    /// A block of the same receivers. \param before is used up
    RowBlock whole(RowBlock before) const;

    /// \param before blocks as they were
    /// \param from   of each receiver of the block: its number before, kNew if there was none
    /// \param block  receives all entries that there were
    /// \return bits: receivers of which it is known whether they have an entry, and which
    std::uint64_t carry(const Row& before, std::span<const std::uint32_t> from, RowBlock& block);

private:
    const std::vector<RowBlock::Draft>& draftsOf(const Row& before, std::uint32_t block);

    std::span<const std::uint32_t> objects_;
    bool renamed_ = false;
    struct Decoded {
        const Row* row = nullptr;
        std::uint32_t block = 0;
        std::vector<RowBlock::Draft> drafts;
    };
    std::vector<Decoded> decoded_; ///< a few blocks: neighbours come from the same ones
    std::size_t oldest_ = 0;
    std::vector<RowBlock::Draft> drafts_;
};

} // namespace penumbra
