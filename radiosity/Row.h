// The shadow-form-factor-list: what every sender does to every receiver, and who is in the way.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace penumbra {

/// One blocker of an entry: an object and the visibility samples that it was found to block.
struct Blocker {
    std::uint32_t object;
    std::uint64_t samples;
};

/// Up to 64 consecutive receivers of one row.
///
/// Most entries are wholly visible or wholly blocked by one object, so these cost one or two words:
///
///     words:  form factor of each present entry (float) | code of each entry that is not wholly
///             visible | side records
///     code:   object id, the one that blocks every sample; or 0x80000000 + offset of a side record
///     side, narrow (only samples 0 ... 15 were taken, object ids fit 16 bits):
///             blockers | visible samples << 16
///             visibility (float), unless no sample is visible
///             for each blocker object << 16 | its samples
///     side, wide:
///             blockers | 0x8000
///             visibility (float) | visible samples (2 words)
///             for each blocker its object | its samples (2 words)
///
/// Receivers that can't face the sender at all have no entry.
class RowBlock {
public:
    static constexpr int kSize = 64;

    /// An entry in the making.
    struct Draft {
        float formFactor = 0;  ///< unoccluded; 0: no entry
        float visibility = 1;  ///< weighted share of the samples that are visible
        std::uint64_t visible; ///< mask of the visible samples
        int blockerCount = 0;  ///< 0: all samples are visible
        std::array<Blocker, kSize> blockers;

        void begin(float factor) {
            formFactor = factor;
            visibility = 1;
            visible = 0;
            blockerCount = 0;
        }
        void block(std::uint32_t object, int sample) {
            int b = 0;
            while (b < blockerCount && blockers[std::size_t(b)].object != object) ++b;
            if (b == blockerCount) blockers[std::size_t(blockerCount++)] = {object, 0};
            blockers[std::size_t(b)].samples |= std::uint64_t(1) << sample;
        }
    };
    void assign(std::span<const Draft> drafts);

    /// Calls visit(receiver in the block, form factor times visibility), in order.
    template <class Visit>
    void forEach(Visit visit) const {
        std::size_t entry = 0, hidden = 0;
        const std::size_t codes = std::size_t(std::popcount(present_));
        for (std::uint64_t left = present_; left != 0; left &= left - 1, ++entry) {
            const int receiver = std::countr_zero(left);
            float factor = std::bit_cast<float>(words_[entry]);
            if (!(visible_ >> receiver & 1)) {
                const std::uint32_t code = words_[codes + hidden++];
                if (!(code & kMixed)) continue; // blocked by one
                const std::uint32_t* side = words_.get() + (code & ~kMixed);
                if ((*side & kWide) == 0 && *side >> 16 == 0) continue; // blocked by several
                factor *= std::bit_cast<float>(side[1]);
            }
            visit(receiver, factor);
        }
    }

    /// An entry read back.
    struct Entry {
        bool present = false;
        float formFactor = 0, visibility = 0;
        std::uint64_t visible = 0; ///< sample mask; all ones if wholly visible, 0 if wholly blocked
        std::vector<Blocker> blockers;
    };
    Entry entry(int receiver) const;

    int entryCount() const { return std::popcount(present_); }
    std::size_t bytes() const { return sizeof *this + wordCount_ * sizeof(std::uint32_t); }

private:
    static constexpr std::uint32_t kMixed = 0x80000000u; ///< in a code
    static constexpr std::uint32_t kWide = 0x8000u;      ///< in a side record's first word

    static void appendSide(const Draft& draft, std::vector<std::uint32_t>& side);

    std::uint64_t present_ = 0; ///< receivers that have an entry
    std::uint64_t visible_ = 0; ///< those of them that are wholly visible
    std::uint32_t wordCount_ = 0;
    std::unique_ptr<std::uint32_t[]> words_;
};

/// A row: one sender's entries, block by block. Blocks are independent of each other.
using Row = std::vector<RowBlock>;

/// Sizes of a row, for statistics.
struct RowSize {
    std::size_t entries = 0, bytes = 0;
};
RowSize sizeOf(const Row& row);

} // namespace penumbra
