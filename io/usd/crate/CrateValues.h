// Values of attributes, dictionaries and metadata: representations become UsdValues.
#pragma once

#include "io/usd/crate/CrateFile.h"
#include "io/usd/layer/UsdLayer.h"

namespace penumbra {

/// Each reads what a representation stands for, or throws CrateFault.

/// Numbers, strings, arrays, dictionaries, or a block. Its type is the file's own: `float3` for
/// what an attribute declares as `color3f`.
UsdValue crateValue(CrateFile& file, CrateRep rep);

/// Types that the fields of specs have, and attributes don't.
std::vector<std::uint32_t> crateTokens(CrateFile& file, CrateRep rep); ///< token indices
std::vector<std::string> crateStrings(CrateFile& file, CrateRep rep);
std::vector<UsdLayerOffset> crateLayerOffsets(CrateFile& file, CrateRep rep);
UsdDictionary crateVariantSelections(CrateFile& file, CrateRep rep);
std::vector<UsdRelocate> crateRelocates(CrateFile& file, CrateRep rep);
/// Refuses samples whose times don't rise.
std::vector<UsdTimeSample> crateTimeSamples(CrateFile& file, CrateRep rep);

/// The representation that a value within a value leads to; `in` goes on behind it.
CrateRep takeCrateRep(CrateFile& file, CrateBytes& in);
/// A dictionary that begins at `in`.
UsdDictionary takeCrateDictionary(CrateFile& file, CrateBytes& in, int depth = 1);

} // namespace penumbra
