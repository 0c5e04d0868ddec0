#include "io/usd/compose/UsdMapping.h"

#include <algorithm>

namespace penumbra {

namespace {

using Pair = UsdMapping::Pair;

const Pair* find(const std::vector<Pair>& pairs, UsdSitePath Pair::*end, UsdSitePath path) {
    const auto at = std::lower_bound(
        pairs.begin(), pairs.end(), path.id(),
        [end](const Pair& pair, std::uint32_t id) { return (pair.*end).id() < id; });
    return at != pairs.end() && (*at).*end == path ? &*at : nullptr;
}

// The pair whose end is the longest prefix of `path`.
const Pair* best(const std::vector<Pair>& pairs, UsdSitePath Pair::*end, UsdSitePath path) {
    for (; path; path = path.parent())
        if (const Pair* pair = find(pairs, end, path)) return pair;
    return nullptr;
}

} // namespace

UsdLayerOffset after(const UsdLayerOffset& outer, const UsdLayerOffset& inner) {
    return {outer.offset + outer.scale * inner.offset, outer.scale * inner.scale};
}

UsdMapping::UsdMapping(std::vector<Pair> pairs, const UsdLayerOffset& offset)
    : bySource_(std::move(pairs)), offset_(offset) {
    sort();
    dropRedundant();
}

// Of several pairs with one source the first counts.
void UsdMapping::sort() {
    std::stable_sort(bySource_.begin(), bySource_.end(),
                     [](const Pair& a, const Pair& b) { return a.source.id() < b.source.id(); });
    const auto sameSource = [](const Pair& a, const Pair& b) { return a.source == b.source; };
    bySource_.erase(std::unique(bySource_.begin(), bySource_.end(), sameSource), bySource_.end());
    byTarget_.clear();
    for (const Pair& pair : bySource_)
        if (pair.target) byTarget_.push_back(pair);
    std::stable_sort(byTarget_.begin(), byTarget_.end(),
                     [](const Pair& a, const Pair& b) { return a.target.id() < b.target.id(); });
}

// A pair that says nothing beyond what the next shorter one says already.
void UsdMapping::dropRedundant() {
    if (bySource_.size() < 2) return;
    const auto redundant = [this](const Pair& pair) {
        const Pair* shorter = pair.source.isRoot() ? nullptr : bestSource(pair.source.parent());
        if (!pair.target) return !shorter || !shorter->target;
        if (!shorter || !shorter->target || pair.target.isRoot()) return false;
        return pair.source.replacePrefix(shorter->source, shorter->target) == pair.target &&
               bestTarget(pair.target.parent()) &&
               bestTarget(pair.target.parent())->source == shorter->source;
    };
    std::vector<Pair> kept;
    for (const Pair& pair : bySource_)
        if (!redundant(pair)) kept.push_back(pair);
    if (kept.size() == bySource_.size()) return;
    bySource_ = std::move(kept);
    sort();
}

const Pair* UsdMapping::bestSource(UsdSitePath path) const {
    return best(bySource_, &Pair::source, path);
}

const Pair* UsdMapping::bestTarget(UsdSitePath path) const {
    return best(byTarget_, &Pair::target, path);
}

UsdSitePath UsdMapping::map(UsdSitePath path) const {
    const Pair* pair = bestSource(path);
    if (!pair || !pair->target) return {};
    const UsdSitePath result = path.replacePrefix(pair->source, pair->target);
    const Pair* back = bestTarget(result);
    return back && back->source == pair->source ? result : UsdSitePath();
}

UsdSitePath UsdMapping::mapBack(UsdSitePath path) const {
    const Pair* pair = bestTarget(path);
    if (!pair) return {};
    const UsdSitePath result = path.replacePrefix(pair->target, pair->source);
    const Pair* forth = bestSource(result);
    return forth && forth->source == pair->source ? result : UsdSitePath();
}

bool UsdMapping::isIdentity() const {
    return bySource_.size() == 1 && bySource_[0].source.isRoot() && bySource_[0].target &&
           bySource_[0].target.isRoot() && offset_.offset == 0 && offset_.scale == 1;
}

UsdMapping UsdMapping::inverse() const {
    std::vector<Pair> pairs;
    for (const Pair& pair : byTarget_) pairs.push_back({pair.target, pair.source});
    return UsdMapping(std::move(pairs), {-offset_.offset / offset_.scale, 1 / offset_.scale});
}

UsdMapping UsdMapping::rooted() const {
    if (bySource_.empty()) return *this;
    const UsdSitePath root = bySource_.front().source.root();
    if (find(bySource_, &Pair::source, root)) return *this;
    std::vector<Pair> pairs = bySource_;
    pairs.push_back({root, root});
    return UsdMapping(std::move(pairs), offset_);
}

UsdMapping UsdMapping::after(const UsdMapping& inner) const {
    std::vector<Pair> pairs;
    for (const Pair& pair : inner.bySource_)
        pairs.push_back({pair.source, pair.target ? map(pair.target) : UsdSitePath()});
    for (const Pair& pair : bySource_)
        if (const UsdSitePath source = inner.mapBack(pair.source))
            pairs.push_back({source, pair.target});
    return UsdMapping(std::move(pairs), penumbra::after(offset_, inner.offset_));
}

bool UsdMapping::operator==(const UsdMapping& other) const {
    return bySource_ == other.bySource_ && offset_.offset == other.offset_.offset &&
           offset_.scale == other.offset_.scale;
}

} // namespace penumbra
