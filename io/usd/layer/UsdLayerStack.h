// A root layer with its sublayers.
#pragma once

#include "io/usd/layer/UsdAssets.h"

#include <filesystem>
#include <memory>
#include <vector>

namespace penumbra {

/// A layer of a stack, and how it got there.
struct UsdStackedLayer {
    std::shared_ptr<const UsdLayer> layer;
    UsdLayerOffset offset; ///< its times to those of the root layer
};

/// Reads `root` and, depth first, all its sublayers: strongest first. Times are mapped through the
/// offsets and the ratio of timeCodesPerSecond. A sublayer that is missing, unreadable or part of a
/// cycle is warned of and left out, as OpenUSD does; only the root layer's own faults are thrown.
/// Asset paths are relative to the layer that has them.
/// \param assets finds and reads them
/// \param unread if not null: takes the files that are there but were left out, since they could
///               not be read or understood
std::vector<UsdStackedLayer>
readUsdLayerStack(const std::filesystem::path& root, const UsdAssets& assets,
                  const UsdLayerLimits& limits, Diagnostics& diagnostics,
                  std::vector<std::filesystem::path>* unread = nullptr);

/// The layer's timeCodesPerSecond, else its framesPerSecond, else 24.
double timeCodesPerSecond(const UsdLayer& layer);

} // namespace penumbra
