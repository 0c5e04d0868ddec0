// A scene's layers and what composes them, held together.
#pragma once

#include "io/usd/compose/UsdIndexer.h"

#include <filesystem>
#include <memory>

namespace penumbra {

struct UsdComposeLimits {
    UsdLayerLimits layer;
    UsdIndexLimits index;
    std::size_t prims = 2'000'000;     ///< of the composed scene
    std::size_t opinions = 20'000'000; ///< of all its prims together
    std::size_t levels = 1024;         ///< prims below each other
};

/// Everything that prim indices point to: it must outlive them.
class UsdComposition {
public:
    /// Throws SceneFileError for faults of the root layer; all others are reported.
    /// \param assets finds and reads layers, for as long as prims are indexed
    UsdComposition(const std::filesystem::path& root, const UsdComposeLimits& limits,
                   const UsdAssets& assets)
        : limits_(limits), errors_(diagnostics_), stacks_(paths_, assets, limits.layer, errors_),
          indexer_(stacks_, errors_, limits.index), rootStack_(stacks_.open(root.string())) {}
    UsdComposition(const UsdComposition&) = delete;
    UsdComposition& operator=(const UsdComposition&) = delete;

    const UsdLayerStack& rootStack() const { return rootStack_; }
    UsdPrimIndex root() { return indexer_.root(rootStack_); }
    UsdPrimIndex child(const UsdPrimIndex& parent, const std::string& name) {
        return indexer_.child(parent, name);
    }
    std::vector<std::filesystem::path> files() const { return stacks_.files(); }
    Diagnostics& diagnostics() { return diagnostics_; }
    UsdCompositionErrors& errors() { return errors_; }

    const UsdComposeLimits& limits() const { return limits_; }

private:
    UsdComposeLimits limits_;
    UsdPathTable paths_;
    Diagnostics diagnostics_;
    UsdCompositionErrors errors_;
    UsdLayerStacks stacks_;
    UsdIndexer indexer_;
    const UsdLayerStack& rootStack_;
};

} // namespace penumbra
