// What a layer stack moves elsewhere.
#pragma once

#include "io/usd/compose/UsdMapping.h"

#include <functional>
#include <string>
#include <unordered_map>
#include <vector>

namespace penumbra {

/// The valid relocates of a layer stack.
class UsdRelocates {
public:
    using Pair = UsdMapping::Pair;
    /// Reports a relocate that is left out: its number in the list, and why.
    using Refuse = std::function<void(std::size_t, const std::string&)>;

    UsdRelocates() = default;
    /// \param authored strongest first, sources differ; the target is empty for what is removed
    UsdRelocates(std::vector<Pair> authored, const Refuse& refuse);

    bool empty() const { return pairs_.empty(); }
    /// Whether the paths of relocates below each other grew so long, together, that the rest was
    /// not traced back.
    bool tracesEnd() const { return traced_ >= kMaxTraced; }
    static constexpr std::size_t kMaxTraced = 1'000'000; ///< elements of paths
    bool isSource(UsdSitePath path) const { return bySource_.contains(path); }
    /// The source whose target is `path`; empty if there is none.
    UsdSitePath sourceOf(UsdSitePath path) const;
    /// Relocates whose source is a child of `parent`, and whose target is one; in the order of the
    /// child's name.
    std::vector<Pair> sourcesBelow(UsdSitePath parent) const;
    std::vector<Pair> targetsBelow(UsdSitePath parent) const;
    /// The map of all that is relocated from `path` or from below it, rooted.
    UsdMapping mappingAt(UsdSitePath path) const;

private:
    void keepValid(std::vector<Pair> authored, const Refuse& refuse);
    UsdSitePath traceBack(UsdSitePath source);

    std::size_t traced_ = 0;  // elements of paths
    std::vector<Pair> pairs_; // in the order of their sources' ids
    std::vector<Pair> whole_; // sources traced back through relocates of their ancestors
    std::unordered_map<UsdSitePath, UsdSitePath> bySource_, byTarget_;
    std::unordered_map<UsdSitePath, std::vector<Pair>> bySourceParent_, byTargetParent_;
    // Relocates by each ancestor of their source, itself included: numbers in pairs_ and whole_.
    std::unordered_map<UsdSitePath, std::vector<std::uint32_t>> pairsAt_, wholeAt_;
};

} // namespace penumbra
