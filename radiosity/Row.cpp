// After [Schoeffel1997], whose list keeps one blocker an entry. Departures: samples and their
// blockers are kept one by one where they differ, and form factors are stored apart from
// visibility, so that an entry can be changed by retesting single samples.
#include "radiosity/Row.h"

#include <algorithm>
#include <cassert>

namespace penumbra {

namespace {

std::uint32_t low(std::uint64_t v) {
    return std::uint32_t(v);
}
std::uint32_t high(std::uint64_t v) {
    return std::uint32_t(v >> 32);
}
std::uint64_t join(std::uint32_t a, std::uint32_t b) {
    return std::uint64_t(b) << 32 | a;
}

} // namespace

void RowBlock::assign(std::span<const Draft> drafts) {
    assert(drafts.size() <= kSize);
    present_ = visible_ = 0;
    std::vector<std::uint32_t> factors, codes, side;
    for (std::size_t i = 0; i < drafts.size(); ++i) {
        if (!(drafts[i].formFactor > 0)) continue;
        present_ |= std::uint64_t(1) << i;
        if (drafts[i].blockerCount == 0) visible_ |= std::uint64_t(1) << i;
        factors.push_back(std::bit_cast<std::uint32_t>(drafts[i].formFactor));
    }
    const auto sideStart =
        std::uint32_t(factors.size() + factors.size() - std::size_t(std::popcount(visible_)));
    for (const Draft& draft : drafts) {
        if (!(draft.formFactor > 0) || draft.blockerCount == 0) continue;
        if (draft.visible == 0 && draft.blockerCount == 1) {
            codes.push_back(draft.blockers[0].object);
            continue;
        }
        codes.push_back(kMixed | (sideStart + std::uint32_t(side.size())));
        appendSide(draft, side);
    }
    wordCount_ = std::uint32_t(factors.size() + codes.size() + side.size());
    words_ = std::make_unique_for_overwrite<std::uint32_t[]>(wordCount_);
    std::uint32_t* out = std::copy(factors.begin(), factors.end(), words_.get());
    out = std::copy(codes.begin(), codes.end(), out);
    std::copy(side.begin(), side.end(), out);
}

void RowBlock::appendSide(const Draft& draft, std::vector<std::uint32_t>& side) {
    const auto blockers = std::span(draft.blockers).first(std::size_t(draft.blockerCount));
    const bool wide = draft.visible >> 16 != 0 ||
                      std::any_of(blockers.begin(), blockers.end(), [](const Blocker& b) {
                          return b.samples >> 16 != 0 || b.object >> 16 != 0;
                      });
    const auto count = std::uint32_t(blockers.size());
    const auto visibility = std::bit_cast<std::uint32_t>(draft.visibility);
    if (wide) {
        side.insert(side.end(),
                    {count | kWide, visibility, low(draft.visible), high(draft.visible)});
        for (const Blocker& blocker : blockers)
            side.insert(side.end(), {blocker.object, low(blocker.samples), high(blocker.samples)});
        return;
    }
    side.push_back(count | low(draft.visible) << 16);
    if (draft.visible != 0) side.push_back(visibility);
    for (const Blocker& blocker : blockers)
        side.push_back(blocker.object << 16 | low(blocker.samples));
}

RowBlock::Entry RowBlock::entry(int receiver) const {
    Entry entry;
    const std::uint64_t bit = std::uint64_t(1) << receiver;
    if (!(present_ & bit)) return entry;
    entry.present = true;
    const std::size_t index = std::size_t(std::popcount(present_ & (bit - 1)));
    entry.formFactor = std::bit_cast<float>(words_[index]);
    if (visible_ & bit) {
        entry.visibility = 1;
        entry.visible = ~std::uint64_t(0);
        return entry;
    }
    const std::size_t hidden = std::size_t(std::popcount(present_ & ~visible_ & (bit - 1)));
    const std::uint32_t code = words_[std::size_t(std::popcount(present_)) + hidden];
    if (!(code & kMixed)) {
        entry.blockers.push_back({code, ~std::uint64_t(0)});
        return entry;
    }
    const std::uint32_t* side = words_.get() + (code & ~kMixed);
    const std::uint32_t head = *side++;
    const std::uint32_t count = head & (kWide - 1);
    if (head & kWide) {
        entry.visibility = std::bit_cast<float>(side[0]);
        entry.visible = join(side[1], side[2]);
        side += 3;
        for (std::uint32_t b = 0; b < count; ++b, side += 3)
            entry.blockers.push_back({side[0], join(side[1], side[2])});
        return entry;
    }
    entry.visible = head >> 16;
    if (entry.visible != 0) entry.visibility = std::bit_cast<float>(*side++);
    for (std::uint32_t b = 0; b < count; ++b, ++side)
        entry.blockers.push_back({*side >> 16, *side & 0xffffu});
    return entry;
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
