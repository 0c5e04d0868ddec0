// The shadow-form-factor-list: what every sender does to every receiver, and who is in the way.
#pragma once

#include "base/ObjectId.h"
#include "radiosity/rows/SmallFloat.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <vector>

namespace penumbra {

/// How many of a patch's visibility samples an entry takes, of 16: fewer where little light comes.
/// \param all whether the sender is one that may light a room alone: all of them
constexpr int samplesFor(float formFactor, bool all) {
    return all || formFactor > 0.01f ? 16 : formFactor > 0.0005f ? 4 : 1;
}

/// One blocker of an entry: an object and the visibility samples that it was found to block.
struct Blocker {
    std::uint32_t object;
    std::uint64_t samples;
};

/// Up to 64 consecutive receivers of one row. Receivers that can't face the sender at all have no
/// entry. A block without entries owns no memory; any other is one run of bytes:
///
///     present, visible   8 + 8  masks of receivers: has an entry; and is wholly visible
///     size, objects      2 + 2  bytes of this run; length of the list of objects, | kWideObjects,
///                               | Sharing, | kAllSamples
///     seen               8      mask: some sample is visible       (not if all are wholly visible)
///     form factors       2 each of the present entries, unoccluded (4 in an emitter's row)
///     visibilities       2 each of the entries that are seen, but not wholly (4)
///     shares                    of quarters or cells: 2 for the length of all of them, then 1, 4
///                               or 15 for each of the entries that are seen
///     objects            2 each, with kWideObjects 4: all that block anything in this block
///     records                   of the entries that are not wholly visible, in order
///
/// What is summed in a shot comes first and lies at fixed offsets. A record is as short as its
/// entry is simple. It begins with a code of one byte, two if there are more objects than that can
/// name. The 16 largest codes mean a mixed entry, smaller ones an object that blocks every sample:
///
///     code = index in the list                           wholly blocked by this one
///     code = largest - 15 + wide + 2 implied + 4 (min(blockers, 4) - 1)
///            number of blockers (1 byte), if 4 or more
///            mask of the visible samples, if any is
///            for each blocker its index in the list, and the mask of its samples
///
/// Masks take 2 bytes if only the samples 0 ... 15 were taken, else 8 (wide). The last blocker's
/// mask is left out (implied) if it is just what the others and the visible samples leave over.
class RowBlock {
public:
    static constexpr int kSize = 64;

    /// Whether all of a sender sends alike, or what is seen of it is shared among its cells: those
    /// of a patch, or those of a cluster, which has quarters as well. See SenderLight.h. Emitters
    /// send evenly, and what is said of them is kept as it is; of all others form factors and
    /// visibilities are SmallFloats.
    enum class Sharing : std::uint8_t { emitter, even, cells, quarters };
    static constexpr bool hasShares(Sharing sharing) { return sharing >= Sharing::cells; }

    /// What is seen of a sender, part by part: how much its first, first two, ... parts are, of
    /// 255; the last one is what is left over. By the number of samples of the entry:
    ///
    ///     1    the cell that the sample lies in; of a cluster the shares of its quarters as well
    ///     4    a byte with two bits for each quarter, which cell of it was sampled; 3 of quarters
    ///     16   15 of cells
    static constexpr std::size_t kMostShares = 15;
    static constexpr std::size_t shareCount(Sharing sharing, int samples) {
        if (!hasShares(sharing)) return 0;
        if (samples == 16) return 15;
        return samples == 1 && sharing == Sharing::cells ? 1 : 4;
    }
    /// Of a seen entry.
    struct Shares {
        std::span<const std::uint8_t> bytes;
        int samples = 0;
    };

    /// An entry in the making.
    struct Draft {
        float formFactor = 0;               ///< unoccluded; 0: no entry
        float visibility = 1;               ///< weighted share of the samples that are visible
        std::uint64_t visible;              ///< mask of the visible samples
        int blockerCount = 0;               ///< 0: all samples are visible
        Sharing sharing = Sharing::emitter; ///< the same for all entries of a block
        bool allSamples = false;            ///< see samplesFor(); likewise, false without shares
        std::array<std::uint8_t, kMostShares> shares{};
        std::array<Blocker, kSize> blockers;

        void begin(float factor) {
            formFactor = factor;
            visibility = 1;
            visible = 0;
            blockerCount = 0;
            sharing = Sharing::emitter;
            allSamples = false;
            shares = {};
        }
        void block(std::uint32_t object, int sample) {
            int b = 0;
            while (b < blockerCount && blockers[std::size_t(b)].object != object) ++b;
            if (b == blockerCount) blockers[std::size_t(blockerCount++)] = {object, 0};
            blockers[std::size_t(b)].samples |= std::uint64_t(1) << sample;
        }
        /// Who blocks a sample; ObjectId::kNone if nobody is on record.
        std::uint32_t blockerOf(int sample) const {
            for (int b = 0; b < blockerCount; ++b)
                if (blockers[std::size_t(b)].samples >> sample & 1)
                    return blockers[std::size_t(b)].object;
            return ObjectId::kNone;
        }
    };
    /// \param which bits: those that count; others make no entry, whatever they say
    void assign(std::span<const Draft> drafts, std::uint64_t which = ~std::uint64_t(0));

    /// Back into drafts, for which assign() gives the same block again. Which samples were taken is
    /// not known of simple entries: a wholly visible one has all bits set and no blocker, one that
    /// an object blocks wholly has this blocker with all bits set.
    /// \pre no receiver beyond the end of `drafts` has an entry
    void decode(std::span<Draft> drafts) const;

    Sharing sharing() const {
        return bytes_ ? Sharing((at<std::uint16_t>(kObjects) & kSharing) / kSharingUnit)
                      : Sharing::emitter;
    }
    /// The same as forEach(), with the Shares as well.
    template <class Visit>
    void forEachShared(Visit visit) const {
        const Sharing sharing = this->sharing();
        const bool all = allSamples();
        std::size_t share = firstShare();
        forEachSeen([&](int receiver, float formFactor, float factor) {
            const int samples = samplesFor(formFactor, all);
            const std::size_t count = shareCount(sharing, samples);
            const auto* const bytes = reinterpret_cast<const std::uint8_t*>(bytes_.get()) + share;
            visit(receiver, factor, Shares{{bytes, count}, samples});
            share += count;
        });
    }

    /// Calls visit(receiver in the block, form factor times visibility), in order, for the entries
    /// of which some sample is visible.
    template <class Visit>
    void forEach(Visit visit) const {
        forEachSeen([&](int receiver, float, float factor) { visit(receiver, factor); });
    }

    /// The same with the form factor: visit(receiver, form factor, form factor times visibility).
    template <class Visit>
    void forEachSeen(Visit visit) const {
        if (!bytes_) return;
        sharing() == Sharing::emitter ? forEachSeenOf<float>(visit)
                                      : forEachSeenOf<SmallFloat>(visit);
    }

    /// Calls visit(object) once for every object that blocks any sample in this block.
    template <class Visit>
    void forEachBlocker(Visit visit) const {
        for (std::size_t i = 0; i < objectCount(); ++i) visit(object(i));
    }
    bool blockedBy(std::uint32_t object) const;

    /// Unoccluded, of all entries; 0 if there is none.
    float largestFormFactor() const;

    /// An entry read back.
    struct Entry {
        bool present = false;
        float formFactor = 0, visibility = 0;
        std::uint64_t visible = 0; ///< sample mask; all ones if wholly visible, 0 if wholly blocked
        std::vector<Blocker> blockers;
    };
    Entry entry(int receiver) const;

    /// Bits: receivers that have an entry.
    std::uint64_t present() const { return bytes_ ? at<std::uint64_t>(0) : 0; }
    bool empty() const { return !bytes_; } ///< there are no entries
    int entryCount() const { return std::popcount(present()); }
    /// Has the processor load what is read first: blocks lie all over memory.
    void prefetch() const {
        constexpr std::size_t kLine = 64, kLines = 4;
        for (std::size_t line = 0; bytes_ && line < kLines; ++line)
            __builtin_prefetch(bytes_.get() + line * kLine);
    }
    /// Bytes it takes, what the allocator adds left out.
    std::size_t bytes() const { return sizeof *this + size(); }

    RowBlock copy() const;
    /// Gives the objects other names. \param names by the names that they have
    void rename(std::span<const std::uint32_t> names);

    /// The same entries, visible at the same samples; who blocks the others may differ.
    bool sameMasks(const RowBlock& other) const;
    /// The same to the last byte.
    bool operator==(const RowBlock& other) const;

private:
    class Writer;
    class Reader;

    static constexpr std::size_t kVisible = 8, kBytes = 16, kObjects = 18, kSeen = 20;
    static constexpr std::uint16_t kWideObjects = 0x8000; ///< object ids of 4 bytes
    static constexpr std::uint16_t kSharing = 0x6000, kSharingUnit = 0x2000;
    static constexpr std::uint16_t kAllSamples = 0x1000; ///< not of emitters

    template <class T>
    T at(std::size_t offset) const {
        T value;
        std::memcpy(&value, bytes_.get() + offset, sizeof value);
        return value;
    }
    std::uint64_t visible() const { return bytes_ ? at<std::uint64_t>(kVisible) : 0; }
    std::uint64_t seen() const {
        return present() == visible() ? visible() : at<std::uint64_t>(kSeen);
    }
    std::size_t size() const { return bytes_ ? at<std::uint16_t>(kBytes) : 0; }
    bool allSamples() const {
        return hasShares(sharing()) && (at<std::uint16_t>(kObjects) & kAllSamples) != 0;
    }
    std::size_t objectCount() const {
        if (!bytes_) return 0;
        // Of an emitter there may be 64 blockers an entry: 0x1000 in all.
        const unsigned flags =
            kWideObjects | kSharing | (sharing() == Sharing::emitter ? 0u : unsigned(kAllSamples));
        return at<std::uint16_t>(kObjects) & ~flags;
    }
    std::size_t objectSize() const { return at<std::uint16_t>(kObjects) & kWideObjects ? 4 : 2; }

    /// Where the parts begin. \pre there are entries
    std::size_t factors() const { return present() == visible() ? kSeen : kSeen + 8; }
    /// Bytes of a form factor and of a visibility.
    std::size_t width() const {
        return sharing() == Sharing::emitter ? sizeof(float) : sizeof(SmallFloat);
    }
    std::size_t visibilities() const {
        return factors() + width() * std::size_t(std::popcount(present()));
    }
    std::size_t shares() const {
        return visibilities() + width() * std::size_t(std::popcount(seen() & ~visible()));
    }
    std::size_t firstShare() const {
        return bytes_ ? shares() + (hasShares(sharing()) ? 2 : 0) : 0;
    }
    std::size_t objects() const {
        const std::size_t from = shares();
        return hasShares(sharing()) ? from + 2 + at<std::uint16_t>(from) : from;
    }
    std::size_t records() const { return objects() + objectSize() * objectCount(); }
    std::uint32_t object(std::size_t i) const {
        return objectSize() == 4 ? at<std::uint32_t>(objects() + 4 * i)
                                 : at<std::uint16_t>(objects() + 2 * i);
    }

    /// A form factor or a visibility.
    float number(std::size_t offset) const {
        return sharing() == Sharing::emitter ? at<float>(offset) : float(at<SmallFloat>(offset));
    }
    /// \tparam Number that form factors and visibilities are \pre there are entries
    template <class Number, class Visit>
    void forEachSeenOf(Visit& visit) const {
        const std::uint64_t present = at<std::uint64_t>(0), visible = at<std::uint64_t>(kVisible);
        std::size_t factor = factors();
        if (present == visible) {
            for (std::uint64_t left = present; left != 0; left &= left - 1) {
                const float formFactor = at<Number>(factor);
                visit(std::countr_zero(left), formFactor, formFactor);
                factor += sizeof(Number);
            }
            return;
        }
        const Number all(1);
        const auto* const wholly = reinterpret_cast<const std::byte*>(&all);
        const std::byte* share = bytes_.get() + visibilities();
        for (std::uint64_t left = at<std::uint64_t>(kSeen); left != 0; left &= left - 1) {
            const std::uint64_t before = (left & (~left + 1)) - 1; // receivers
            const int receiver = std::countr_zero(left);
            const float formFactor =
                at<Number>(factor + sizeof(Number) * std::size_t(std::popcount(present & before)));
            const bool whole = visible >> receiver & 1;
            Number visibility; // without a branch, which nothing could foresee
            std::memcpy(&visibility, whole ? wholly : share, sizeof visibility);
            share += whole ? 0 : sizeof visibility;
            visit(receiver, formFactor, formFactor * float(visibility));
        }
    }

    std::unique_ptr<std::byte[]> bytes_;
};

/// A row: one sender's entries, block by block. Blocks are independent of each other. A row has
/// either the blocks 0 ... size - 1, or some of all blocks, by ascending index.
class Row {
public:
    bool empty() const { return entries_.empty(); }
    std::size_t size() const { return entries_.size(); }
    std::vector<RowBlock>::iterator begin() { return entries_.begin(); }
    std::vector<RowBlock>::iterator end() { return entries_.end(); }
    std::vector<RowBlock>::const_iterator begin() const { return entries_.begin(); }
    std::vector<RowBlock>::const_iterator end() const { return entries_.end(); }
    /// Index of the block in slot `i`.
    std::uint32_t blockAt(std::size_t i) const {
        return indices_.empty() ? std::uint32_t(i) : indices_[i];
    }

    /// The first slot whose block is not before this one.
    std::size_t slotFrom(std::uint32_t block) const;

    /// Has the blocks 0 ... count - 1. \pre none was opened
    void resize(std::size_t count) { entries_.resize(count); }
    /// Has these blocks, all without entries as yet. \pre empty(), `blocks` ascending
    void open(std::span<const std::uint32_t> blocks);
    /// Has this block as well. \pre resize() was not used
    void open(std::uint32_t block);
    void clear();

    bool has(std::uint32_t block) const { return find(block) != nullptr; }
    /// \pre has(block)
    RowBlock& operator[](std::size_t block) {
        return const_cast<RowBlock&>(*find(std::uint32_t(block)));
    }
    const RowBlock& operator[](std::size_t block) const { return *find(std::uint32_t(block)); }
    /// The same. \param slot where it is likely to be
    RowBlock& at(std::uint32_t block, std::size_t slot) {
        return slot < size() && blockAt(slot) == block ? entries_[slot] : (*this)[block];
    }
    /// Null if the row does not have the block.
    const RowBlock* find(std::uint32_t block) const;

private:
    std::vector<std::uint32_t> indices_; ///< empty: of the first blocks
    std::vector<RowBlock> entries_;
};

/// Sizes of a row, for statistics.
struct RowSize {
    std::size_t entries = 0, bytes = 0;
};
RowSize sizeOf(const Row& row);

} // namespace penumbra
