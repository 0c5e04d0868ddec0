// The composed scene as one layer.
#pragma once

#include "io/usd/layer/UsdAssets.h"
#include "io/usd/stage/UsdStage.h"

#include <filesystem>

namespace penumbra {

/// All that the stage says, as one layer without composition arcs: sublayers, references, payloads,
/// inherits, specializes, the chosen variants and relocates are worked in. Times are those of the
/// stage, targets its paths; the paths of assets lead from `output` to the same files. What is
/// below instanceable prims is written in place of each, and none is instanceable any more.
/// Inactive prims, variants that are not chosen, and the order that `reorder` statements ask for
/// beyond that of the prims are not in it.
///
/// \param assets those that the stage was opened with \param output where the layer will lie
UsdLayer flattenUsdStage(const UsdStage& stage, const UsdAssets& assets,
                         const std::filesystem::path& output);

} // namespace penumbra
