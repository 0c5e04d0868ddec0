// After [Schoeffel1997], whose list keeps one blocker an entry. Departures: samples and their
// blockers are kept one by one where they differ, and form factors are stored apart from
// visibility, so that an entry can be changed by retesting single samples.
#include "radiosity/rows/Row.h"

#include "base/Bits.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace penumbra {

namespace {

constexpr std::uint64_t kAll = ~std::uint64_t(0);

/// Codes that mean a mixed entry: the largest ones.
constexpr std::size_t kMixedCodes = 16;

/// Size of a code, and of an index into the list of objects.
std::size_t codeSize(std::size_t objects) {
    return objects <= 256 - kMixedCodes ? 1 : 2;
}
std::size_t firstMixed(std::size_t codeSize) {
    return (codeSize == 1 ? 256u : 65536u) - kMixedCodes;
}

/// What a mixed entry's code says.
struct MixedForm {
    bool wide = false, implied = false;
    std::size_t blockers = 1; ///< 4: or more

    std::size_t code() const { return std::size_t(wide) + 2 * implied + 4 * (blockers - 1); }
    static MixedForm of(std::size_t code) {
        return {(code & 1) != 0, (code & 2) != 0, (code >> 2) + 1};
    }
    std::size_t maskSize() const { return wide ? 8 : 2; }
    std::uint64_t allSamples() const { return wide ? kAll : 0xffff; }
};

std::span<const Blocker> blockersOf(const RowBlock::Draft& draft) {
    return std::span(draft.blockers).first(std::size_t(draft.blockerCount));
}

/// Samples that are visible or that a blocker but the last one has.
std::uint64_t allButLast(std::uint64_t visible, std::span<const Blocker> blockers) {
    for (const Blocker& blocker : blockers.first(blockers.size() - 1)) visible |= blocker.samples;
    return visible;
}

} // namespace

/// Lists the objects of a block, then puts its parts one after the other.
class RowBlock::Writer {
public:
    Writer(std::span<const Draft> drafts, std::uint64_t which) : drafts_(drafts) {
        for (std::size_t i = 0; i < drafts.size(); ++i)
            if ((which >> i & 1) && drafts[i].formFactor > 0) present_ |= std::uint64_t(1) << i;
        for (const int i : bitsOf(present_)) list(i);
    }

    std::unique_ptr<std::byte[]> write() {
        if (present_ == 0) return nullptr;
        put(present_);
        put(visible_);
        put(std::uint16_t(0)); // the size, not yet known
        put(std::uint16_t(objectCount_ | (wideObjects_ ? kWideObjects : 0u) |
                          unsigned(sharing_) * kSharingUnit |
                          (hasShares(sharing_) && allSamples_ ? kAllSamples : 0u)));
        if (present_ != visible_) put(seen_);
        for (const int i : bitsOf(present_)) putNumber(draft(i).formFactor);
        for (const int i : bitsOf(seen_ & ~visible_)) putNumber(draft(i).visibility);
        putShares();
        for (const std::uint32_t object : objects()) putLow(object, wideObjects_ ? 4 : 2);
        for (const int i : bitsOf(present_ & ~visible_)) putRecord(draft(i));

        const auto size = std::uint16_t(size_);
        std::memcpy(out_.data() + kBytes, &size, sizeof size);
        auto bytes = std::make_unique_for_overwrite<std::byte[]>(size);
        std::copy_n(out_.data(), size, bytes.get());
        return bytes;
    }

private:
    const Draft& draft(int i) const { return drafts_[std::size_t(i)]; }
    /// Notes what of an entry concerns the block.
    void list(int i) {
        const Draft& draft = this->draft(i);
        const std::uint64_t bit = std::uint64_t(1) << i;
        sharing_ = std::max(sharing_, draft.sharing);
        allSamples_ |= draft.allSamples;
        if (draft.blockerCount == 0) visible_ |= bit;
        if (draft.blockerCount == 0 || draft.visible != 0) seen_ |= bit;
        for (const Blocker& blocker : blockersOf(draft)) {
            if (place(blocker.object) == objectCount_) objects_[objectCount_++] = blocker.object;
            wideObjects_ |= blocker.object >> 16 != 0;
        }
    }
    template <class T>
    void put(T value) {
        putLow(value, sizeof value);
    }
    /// The first bytes of a little-endian value.
    template <class T>
    void putLow(T value, std::size_t size) {
        assert(size_ + sizeof value <= out_.size());
        std::memcpy(out_.data() + size_, &value, sizeof value); // what is too much is written over
        size_ += size;
    }
    void putNumber(float value) {
        sharing_ == Sharing::emitter ? put(value) : put(SmallFloat(value));
    }
    std::span<const std::uint32_t> objects() const {
        return std::span(objects_).first(objectCount_);
    }
    std::size_t place(std::uint32_t object) const {
        return std::size_t(std::ranges::find(objects(), object) - objects().begin());
    }

    void putShares() {
        if (!hasShares(sharing_)) return;
        std::size_t all = 0;
        const auto countOf = [this](int i) {
            return shareCount(sharing_, samplesFor(draft(i).formFactor, allSamples_));
        };
        for (const int i : bitsOf(seen_)) all += countOf(i);
        put(std::uint16_t(all));
        for (const int i : bitsOf(seen_))
            for (std::size_t k = 0; k < countOf(i); ++k) put(draft(i).shares[k]);
    }

    void putRecord(const Draft& draft) {
        const std::span<const Blocker> blockers = blockersOf(draft);
        const std::size_t codes = codeSize(objectCount_);
        if (draft.visible == 0 && blockers.size() == 1) {
            putLow(place(blockers[0].object), codes);
            return;
        }
        MixedForm form;
        form.wide = draft.visible >> 16 != 0 ||
                    std::any_of(blockers.begin(), blockers.end(),
                                [](const Blocker& b) { return b.samples >> 16 != 0; });
        form.implied =
            blockers.back().samples == (form.allSamples() & ~allButLast(draft.visible, blockers));
        form.blockers = std::min<std::size_t>(blockers.size(), 4);
        putLow(firstMixed(codes) + form.code(), codes);
        if (form.blockers == 4) put(std::uint8_t(blockers.size()));
        if (draft.visible != 0) putLow(draft.visible, form.maskSize());
        for (std::size_t b = 0; b < blockers.size(); ++b) {
            putLow(place(blockers[b].object), codes);
            if (b + 1 < blockers.size() || !form.implied)
                putLow(blockers[b].samples, form.maskSize());
        }
    }

    std::span<const Draft> drafts_;
    std::uint64_t present_ = 0, visible_ = 0, seen_ = 0;
    bool wideObjects_ = false, allSamples_ = false;
    Sharing sharing_ = Sharing::emitter;
    std::array<std::uint32_t, std::size_t(kSize) * kSize> objects_;
    std::size_t objectCount_ = 0;
    std::array<std::byte, 65536> out_; ///< 64 entries of 64 blockers, all different, take less
    std::size_t size_ = 0;             ///< written so far
};

/// Goes through the entries of a block, in order.
class RowBlock::Reader {
public:
    explicit Reader(const RowBlock& block) : block_(block), left_(block.present()) {
        if (left_ == 0) return;
        visible_ = block.visible();
        seen_ = block.seen();
        factor_ = block.factors();
        share_ = block.visibilities();
        sharing = block.sharing();
        allSamples = block.allSamples();
        shares_ = block.firstShare();
        record_ = block.records();
        objects_ = block.objects();
        objectSize_ = block.objectSize();
        codeSize_ = codeSize(block.objectCount());
    }

    /// Reads the next entry.
    bool next() {
        if (left_ == 0) return false;
        receiver = std::countr_zero(left_);
        left_ &= left_ - 1;
        formFactor = block_.number(factor_);
        factor_ += block_.width();
        visibility = 1;
        visible = kAll;
        blockers = {};
        shares = {};
        if (seen_ >> receiver & 1) {
            const std::size_t count = shareCount(sharing, samplesFor(formFactor, allSamples));
            std::memcpy(shares.data(), block_.bytes_.get() + shares_, count);
            shares_ += count;
        }
        if (visible_ >> receiver & 1) return true;
        visibility = 0;
        visible = 0;
        const bool seen = seen_ >> receiver & 1;
        if (seen) {
            visibility = block_.number(share_);
            share_ += block_.width();
        }
        readRecord(seen);
        return true;
    }

    int receiver = 0;
    float formFactor = 0, visibility = 0;
    std::uint64_t visible = 0;
    std::span<const Blocker> blockers;
    Sharing sharing = Sharing::emitter;
    bool allSamples = false;
    std::array<std::uint8_t, kMostShares> shares{};

private:
    std::uint64_t take(std::size_t size) {
        const std::size_t from = std::exchange(record_, record_ + size);
        switch (size) { // sizes that the compiler knows are single loads
        case 1:
            return block_.at<std::uint8_t>(from);
        case 2:
            return block_.at<std::uint16_t>(from);
        default:
            return block_.at<std::uint64_t>(from);
        }
    }
    std::uint32_t object(std::size_t place) const {
        const std::size_t at = objects_ + objectSize_ * place;
        return objectSize_ == 4 ? block_.at<std::uint32_t>(at) : block_.at<std::uint16_t>(at);
    }

    void readRecord(bool seen) {
        const std::size_t code = take(codeSize_), mixed = firstMixed(codeSize_);
        if (code < mixed) {
            scratch_[0] = {object(code), kAll};
            blockers = std::span(scratch_).first(1);
            return;
        }
        const MixedForm form = MixedForm::of(code - mixed);
        blockers = std::span(scratch_).first(form.blockers < 4 ? form.blockers : take(1));
        if (seen) visible = take(form.maskSize());
        for (std::size_t b = 0; b < blockers.size(); ++b) {
            scratch_[b].object = object(take(codeSize_));
            scratch_[b].samples = b + 1 < blockers.size() || !form.implied
                                      ? take(form.maskSize())
                                      : form.allSamples() & ~allButLast(visible, blockers);
        }
    }

    const RowBlock& block_;
    std::uint64_t left_, visible_ = 0, seen_ = 0;
    std::size_t factor_ = 0, share_ = 0, shares_ = 0, record_ = 0; ///< offsets in the bytes
    std::size_t objects_ = 0, objectSize_ = 0, codeSize_ = 0;
    std::array<Blocker, kSize> scratch_;
};

void RowBlock::assign(std::span<const Draft> drafts, std::uint64_t which) {
    static_assert(std::endian::native == std::endian::little);
    assert(drafts.size() <= kSize);
    bytes_ = Writer(drafts, which).write();
}

void RowBlock::decode(std::span<Draft> drafts) const {
    for (Draft& draft : drafts) draft.begin(0);
    for (Reader read(*this); read.next();) {
        Draft& draft = drafts[std::size_t(read.receiver)];
        draft.begin(read.formFactor);
        draft.visibility = read.visibility;
        draft.visible = read.visible;
        draft.sharing = read.sharing;
        draft.allSamples = read.allSamples;
        draft.shares = read.shares;
        draft.blockerCount = int(read.blockers.size());
        std::copy(read.blockers.begin(), read.blockers.end(), draft.blockers.begin());
    }
}

RowBlock::Entry RowBlock::entry(int receiver) const {
    Entry entry;
    for (Reader read(*this); read.next();) {
        if (read.receiver != receiver) continue;
        entry = {true,
                 read.formFactor,
                 read.visibility,
                 read.visible,
                 {read.blockers.begin(), read.blockers.end()}};
        break;
    }
    return entry;
}

bool RowBlock::blockedBy(std::uint32_t object) const {
    bool found = false;
    forEachBlocker([&](std::uint32_t o) { found |= o == object; });
    return found;
}

float RowBlock::largestFormFactor() const {
    float largest = 0;
    for (int i = 0; i < entryCount(); ++i)
        largest = std::max(largest, number(factors() + width() * std::size_t(i)));
    return largest;
}

RowBlock RowBlock::copy() const {
    RowBlock same;
    if (!bytes_) return same;
    same.bytes_ = std::make_unique_for_overwrite<std::byte[]>(size());
    std::copy_n(bytes_.get(), size(), same.bytes_.get());
    return same;
}

void RowBlock::rename(std::span<const std::uint32_t> names) {
    bool fits = true;
    forEachBlocker([&](std::uint32_t object) {
        fits = fits && (names[object] >> 16 != 0) == (objectSize() == 4);
    });
    if (!fits) { // names of another length
        std::vector<Draft> drafts(kSize);
        decode(drafts);
        for (Draft& draft : drafts)
            for (int b = 0; b < draft.blockerCount; ++b)
                draft.blockers[std::size_t(b)].object =
                    names[draft.blockers[std::size_t(b)].object];
        assign(drafts);
        return;
    }
    for (std::size_t i = 0; i < objectCount(); ++i) {
        const std::uint32_t name = names[object(i)];
        std::memcpy(bytes_.get() + objects() + objectSize() * i, &name, objectSize());
    }
}

bool RowBlock::sameMasks(const RowBlock& other) const {
    if (present() != other.present() || visible() != other.visible()) return false;
    for (Reader a(*this), b(other); a.next() && b.next();)
        if (a.visible != b.visible) return false;
    return true;
}

bool RowBlock::operator==(const RowBlock& other) const {
    return size() == other.size() &&
           std::equal(bytes_.get(), bytes_.get() + size(), other.bytes_.get());
}

void Row::open(std::span<const std::uint32_t> blocks) {
    indices_.assign(blocks.begin(), blocks.end());
    entries_.resize(blocks.size());
}

void Row::open(std::uint32_t block) {
    const auto place = std::lower_bound(indices_.begin(), indices_.end(), block);
    if (place != indices_.end() && *place == block) return;
    entries_.emplace(entries_.begin() + (place - indices_.begin()));
    indices_.insert(place, block);
}

void Row::clear() {
    indices_.clear();
    entries_.clear();
}

std::size_t Row::slotFrom(std::uint32_t block) const {
    if (indices_.empty()) return std::min<std::size_t>(block, entries_.size());
    const auto place = std::lower_bound(indices_.begin(), indices_.end(), block);
    return std::size_t(place - indices_.begin());
}

const RowBlock* Row::find(std::uint32_t block) const {
    if (indices_.empty()) return block < entries_.size() ? &entries_[block] : nullptr;
    const auto place = std::lower_bound(indices_.begin(), indices_.end(), block);
    return place != indices_.end() && *place == block
               ? &entries_[std::size_t(place - indices_.begin())]
               : nullptr;
}

RowSize sizeOf(const Row& row) {
    RowSize size;
    for (const RowBlock& block : row) {
        size.entries += std::size_t(block.entryCount());
        size.bytes += block.bytes();
    }
    return size;
}

} // namespace penumbra
