#include "radiosity/rows/EntryCarrier.h"

#include <algorithm>

namespace penumbra {

namespace {

constexpr std::size_t kDecoded = 4; ///< blocks that are remembered

} // namespace

EntryCarrier::EntryCarrier(std::span<const std::uint32_t> objects)
    : objects_(objects), decoded_(kDecoded), drafts_(RowBlock::kSize) {
    for (std::uint32_t o = 0; o < objects.size(); ++o) renamed_ |= objects[o] != o;
}

RowBlock EntryCarrier::whole(RowBlock before) const {
    if (renamed_) before.rename(objects_);
    return before;
}

const std::vector<RowBlock::Draft>& EntryCarrier::draftsOf(const Row& before, std::uint32_t block) {
    for (const Decoded& known : decoded_)
        if (known.row == &before && known.block == block) return known.drafts;
    Decoded& next = decoded_[oldest_++ % kDecoded];
    next.row = &before;
    next.block = block;
    next.drafts.resize(RowBlock::kSize);
    before[block].decode(next.drafts);
    for (RowBlock::Draft& draft : next.drafts)
        for (int b = 0; renamed_ && b < draft.blockerCount; ++b)
            draft.blockers[std::size_t(b)].object = objects_[draft.blockers[std::size_t(b)].object];
    return next.drafts;
}

std::uint64_t EntryCarrier::carry(const Row& before, std::span<const std::uint32_t> from,
                                  RowBlock& block) {
    constexpr std::uint32_t kSize = RowBlock::kSize;
    std::uint64_t known = 0;
    for (std::uint32_t r = 0; r < kSize; ++r)
        if (from[r] != kNew && before.has(from[r] / kSize)) known |= std::uint64_t(1) << r;
    if (known == 0) return 0;
    for (std::uint32_t r = 0; r < kSize; ++r)
        if (known >> r & 1)
            drafts_[r] = draftsOf(before, from[r] / kSize)[from[r] % kSize];
        else
            drafts_[r].begin(0);
    block.assign(drafts_);
    return known;
}

} // namespace penumbra
