// Fields that are metadata, and values made to fit a declared type.
#pragma once

#include "io/usd/crate/CrateFile.h"
#include "io/usd/layer/UsdLayer.h"

namespace penumbra {

/// Adds a field as the text format's parser would have it: keys with a prescribed type hold a value
/// of that type, dictionaries are dictionaries, all others hold text. Throws CrateFault.
void addCrateMetadata(CrateFile& file, std::string_view field, CrateRep rep,
                      UsdDictionary& metadata);

/// `value` as one of type `declared`: other numbers are converted, strings and tokens are the same,
/// and a value of an unknown type becomes text. False if it can't be one.
bool fitUsdValue(UsdValue& value, UsdType declared);

/// The value `reorder x = [...]` has.
UsdValue crateNameOrder(CrateFile& file, CrateRep rep);

} // namespace penumbra
