// A layer's specs by their path.
#pragma once

#include "io/usd/compose/UsdSitePath.h"
#include "io/usd/layer/UsdLayer.h"

#include <unordered_map>

namespace penumbra {

/// Finds what a layer says about a prim, within variants too. The layer must outlive it.
class UsdLayerIndex {
public:
    UsdLayerIndex(const UsdLayer& layer, UsdPathTable& paths);
    /// Null if the layer says nothing about it.
    const UsdPrimSpec* spec(UsdSitePath path) const {
        const auto found = specs_.find(path);
        return found == specs_.end() ? nullptr : found->second;
    }

private:
    std::unordered_map<UsdSitePath, const UsdPrimSpec*> specs_;
};

} // namespace penumbra
