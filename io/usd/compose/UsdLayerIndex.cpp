#include "io/usd/compose/UsdLayerIndex.h"

#include <utility>
#include <vector>

namespace penumbra {

UsdLayerIndex::UsdLayerIndex(const UsdLayer& layer, UsdPathTable& paths) {
    std::vector<std::pair<const UsdPrimSpec*, UsdSitePath>> open;
    for (const UsdPrimSpec& prim : layer.prims)
        open.emplace_back(&prim, paths.root().child(prim.name));
    while (!open.empty()) {
        const auto [spec, path] = open.back();
        open.pop_back();
        specs_.try_emplace(path, spec);
        for (const UsdPrimSpec& child : spec->children)
            open.emplace_back(&child, path.child(child.name));
        for (const UsdVariantSet& set : spec->variantSets)
            for (const UsdPrimSpec& variant : set.variants)
                open.emplace_back(&variant, path.withChoice(set.name, variant.name));
    }
}

} // namespace penumbra
