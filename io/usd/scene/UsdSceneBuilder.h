// The prims of a stage as nodes.
#pragma once

#include "io/usd/scene/UsdAddresses.h"
#include "io/usd/scene/UsdTracks.h"
#include "io/usd/shade/UsdTextures.h"
#include "io/usd/stage/UsdStage.h"
#include "scenegraph/Group.h"

#include <cstddef>
#include <memory>

namespace penumbra {

struct UsdBuildOptions {
    UsdTime time;                  ///< at which values are read
    std::size_t mostInstanced = 0; ///< nodes that instances may make, see LoadOptions
    double metersPerUnit = 1;      ///< of the stage [m]
};

/// Makes nodes of all prims that are seen, give light or look, below `root`, in units of the stage.
/// \param tracks    gets what changes with time
/// \param addresses gets what of the scene comes from which prim
void buildUsdScene(UsdStage& stage, const UsdBuildOptions& options, UsdTextures& textures,
                   UsdTracks& tracks, UsdAddresses& addresses, std::shared_ptr<Group> root);

} // namespace penumbra
