// A root layer with its sublayers.
#pragma once

#include "io/usd/compose/UsdLayerIndex.h"
#include "io/usd/compose/UsdRelocates.h"
#include "io/usd/layer/UsdAssets.h"

#include <memory>
#include <string>
#include <vector>

namespace penumbra {

/// A layer that was read. Stacks share it.
struct UsdLoadedLayer {
    std::string file;                      ///< its identifier, as it was first asked for
    std::shared_ptr<const UsdLayer> layer; ///< null: it could not be read
    std::shared_ptr<const UsdLayerIndex> index;
    std::string problem; ///< why there is none
};

/// A layer of a stack, and how it got there.
struct UsdStackedLayer {
    std::shared_ptr<const UsdLayer> layer;
    std::shared_ptr<const UsdLayerIndex> index;
    std::string file;
    UsdLayerOffset offset; ///< its times to those of the root layer
};

/// Layers that act as one, strongest first. Sites compare by the stack itself: there is one for
/// each root layer and set of expression variables.
struct UsdLayerStack {
    const UsdAssets* assets = nullptr;   ///< where its layers and what they name are found
    std::vector<UsdStackedLayer> layers; ///< at least the root layer
    UsdRelocates relocates;
    UsdDictionary variables; ///< of expressions: the root layer's, what refers to it before those
    double timeCodesPerSecond = 24;

    const UsdLayer& rootLayer() const { return *layers.front().layer; }
    /// Whether some layer says something about a prim.
    bool hasSpec(UsdSitePath path) const;
};

/// The layer's timeCodesPerSecond, else its framesPerSecond, else 24.
double timeCodesPerSecond(const UsdLayer& layer);

/// An offset that was written, or none if it isn't finite or its scale is 0.
bool isValid(const UsdLayerOffset& offset);

} // namespace penumbra
