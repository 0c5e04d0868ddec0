#include "io/usd/compose/UsdRelocates.h"

#include <algorithm>
#include <unordered_set>

namespace penumbra {

namespace {

using Pair = UsdRelocates::Pair;

// Why a relocate is wrong by itself; empty if it isn't.
std::string whyInvalid(const Pair& pair) {
    const UsdSitePath source = pair.source, target = pair.target;
    if (!source || source.isRoot() || (target && target.isRoot())) return "not the path of a prim";
    if (source.length() == 1) return "root prims can't be the source of a relocate";
    if (source == target) return "its target is its source";
    if (target && source.hasPrefix(target)) return "its target is an ancestor of its source";
    if (target && target.hasPrefix(source)) return "its target is a descendant of its source";
    return {};
}

// Whether a proper ancestor of `path` is in `set`.
template <class Set>
bool isBelow(UsdSitePath path, const Set& set) {
    while (!path.isRoot()) {
        path = path.parent();
        if (set.contains(path)) return true;
    }
    return false;
}

std::vector<Pair> listed(const std::unordered_map<UsdSitePath, std::vector<Pair>>& map,
                         UsdSitePath parent) {
    const auto found = map.find(parent);
    return found == map.end() ? std::vector<Pair>() : found->second;
}

} // namespace

UsdRelocates::UsdRelocates(std::vector<Pair> authored, const Refuse& refuse) {
    keepValid(std::move(authored), refuse);
    for (const Pair& pair : pairs_) {
        bySource_[pair.source] = pair.target;
        if (pair.target) byTarget_[pair.target] = pair.source;
    }
    for (const Pair& pair : pairs_) {
        whole_.push_back({traceBack(pair.source), pair.target});
        bySourceParent_[pair.source.parent()].push_back(pair);
        if (pair.target) byTargetParent_[pair.target.parent()].push_back(pair);
    }
    const auto byName = [](auto& lists, UsdSitePath Pair::*end) {
        for (auto& [parent, list] : lists)
            std::sort(list.begin(), list.end(), [end](const Pair& a, const Pair& b) {
                return (a.*end).name() < (b.*end).name();
            });
    };
    byName(bySourceParent_, &Pair::source);
    byName(byTargetParent_, &Pair::target);
    for (std::uint32_t i = 0; i < pairs_.size(); ++i) {
        for (UsdSitePath at = pairs_[i].source; at; at = at.parent()) pairsAt_[at].push_back(i);
        for (UsdSitePath at = whole_[i].source; at; at = at.parent()) wholeAt_[at].push_back(i);
    }
}

// Conflicts count among all that are valid by themselves; then all that conflict go together.
void UsdRelocates::keepValid(std::vector<Pair> authored, const Refuse& refuse) {
    std::vector<std::string> why(authored.size());
    std::unordered_set<UsdSitePath> sources;
    std::unordered_map<UsdSitePath, std::size_t> targets;
    for (std::size_t i = 0; i < authored.size(); ++i) {
        why[i] = whyInvalid(authored[i]);
        if (!why[i].empty()) continue;
        sources.insert(authored[i].source);
        if (authored[i].target) ++targets[authored[i].target];
    }
    for (std::size_t i = 0; i < authored.size(); ++i) {
        const auto [source, target] = authored[i];
        if (!why[i].empty()) continue;
        if (targets.contains(source))
            why[i] = "its source is the target of another relocate";
        else if (target && sources.contains(target))
            why[i] = "its target is the source of another relocate";
        else if (target && targets[target] > 1)
            why[i] = "its target is that of another relocate, too";
        else if (isBelow(source, sources))
            why[i] = "its source is below that of another relocate";
        else if (target && isBelow(target, sources))
            why[i] = "its target is below the source of another relocate";
    }
    for (std::size_t i = 0; i < authored.size(); ++i)
        if (why[i].empty())
            pairs_.push_back(authored[i]);
        else
            refuse(i, why[i]);
    std::sort(pairs_.begin(), pairs_.end(),
              [](const Pair& a, const Pair& b) { return a.source.id() < b.source.id(); });
}

UsdSitePath UsdRelocates::traceBack(UsdSitePath source) {
    constexpr int kMaxSteps = 64; // relocates that feed each other in a circle end here
    for (int step = 0; step < kMaxSteps; ++step) {
        UsdSitePath at = source;
        while (!at.isRoot() && !byTarget_.contains(at)) at = at.parent();
        if (at.isRoot() || tracesEnd()) break;
        source = source.replacePrefix(at, byTarget_.at(at));
        traced_ += source.length();
    }
    return source;
}

UsdSitePath UsdRelocates::sourceOf(UsdSitePath path) const {
    const auto found = byTarget_.find(path);
    return found == byTarget_.end() ? UsdSitePath() : found->second;
}

std::vector<Pair> UsdRelocates::sourcesBelow(UsdSitePath parent) const {
    return listed(bySourceParent_, parent);
}

std::vector<Pair> UsdRelocates::targetsBelow(UsdSitePath parent) const {
    return listed(byTargetParent_, parent);
}

UsdMapping UsdRelocates::mappingAt(UsdSitePath path) const {
    std::vector<Pair> pairs;
    std::unordered_set<UsdSitePath> targets;
    if (const auto found = wholeAt_.find(path); found != wholeAt_.end())
        for (const std::uint32_t i : found->second) {
            if (!whole_[i].target) continue; // what is removed keeps its name
            pairs.push_back(whole_[i]);
            targets.insert(whole_[i].target);
        }
    if (const auto found = pairsAt_.find(path); found != pairsAt_.end())
        for (const std::uint32_t i : found->second)
            if (pairs_[i].target && !targets.contains(pairs_[i].target)) pairs.push_back(pairs_[i]);
    pairs.push_back({path.root(), path.root()});
    return UsdMapping(std::move(pairs), {});
}

} // namespace penumbra
