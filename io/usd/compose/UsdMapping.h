// How paths and times of a node become those of another one.
#pragma once

#include "io/usd/compose/UsdSitePath.h"
#include "io/usd/layer/UsdLayer.h"

#include <memory>
#include <vector>

namespace penumbra {

/// `outer` after `inner`: first inner, then outer is applied.
UsdLayerOffset after(const UsdLayerOffset& outer, const UsdLayerOffset& inner);

/// A map of paths: pairs source -> target, the longest matching source counts. It is one to one: a
/// path is mapped only if the same pair has the longest target that matches the result. Paths never
/// hold choices. Lookups take the logarithm of the number of pairs for each element of the path.
class UsdMapping {
public:
    struct Pair {
        UsdSitePath source;
        UsdSitePath target; ///< empty: what is below the source has no image
        bool operator==(const Pair&) const = default;
    };

    UsdMapping() = default; ///< maps nothing
    UsdMapping(std::vector<Pair> pairs, const UsdLayerOffset& offset);
    static UsdMapping identity(UsdSitePath root) { return UsdMapping({{root, root}}, {}); }

    /// Empty if there is no image.
    UsdSitePath map(UsdSitePath path) const;
    UsdSitePath mapBack(UsdSitePath path) const;
    const UsdLayerOffset& offset() const { return offset_; }
    const std::vector<Pair>& pairs() const { return bySource_; }
    bool isIdentity() const;

    UsdMapping inverse() const;
    /// With / -> / added.
    UsdMapping rooted() const;
    /// This one after `inner`.
    UsdMapping after(const UsdMapping& inner) const;
    bool operator==(const UsdMapping& other) const;

private:
    const Pair* bestSource(UsdSitePath path) const;
    const Pair* bestTarget(UsdSitePath path) const;
    void dropRedundant();
    void sort();

    std::vector<Pair> bySource_; // sorted by the source's id
    std::vector<Pair> byTarget_; // those with a target, sorted by its id
    UsdLayerOffset offset_;
};

using UsdMappingPtr = std::shared_ptr<const UsdMapping>;

} // namespace penumbra
