// Fields of layers and prims.
#pragma once

#include "io/usd/crate/CrateFile.h"
#include "io/usd/layer/UsdLayer.h"

namespace penumbra {

/// What the fields of a spec say of others: the names of what lies below it, as tokens.
struct CrateChildren {
    std::vector<std::uint32_t> prims, properties, variantSets, variants;
    std::vector<UsdLayerOffset> subLayerOffsets; ///< of the layer, in the order of its sublayers
};

/// Each puts one field where it belongs. Throws CrateFault.
void readCrateLayerField(CrateFile& file, std::string_view name, CrateRep rep, UsdLayer& layer,
                         CrateChildren& children);
void readCratePrimField(CrateFile& file, std::string_view name, CrateRep rep, UsdPrimSpec& spec,
                        CrateChildren& children);

} // namespace penumbra
