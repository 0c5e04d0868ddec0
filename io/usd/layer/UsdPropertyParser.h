// Attribute and relationship statements.
#pragma once

#include "io/usd/layer/UsdLayer.h"
#include "io/usd/layer/UsdNameIndex.h"

#include <string>
#include <vector>

namespace penumbra {

/// The properties of the prim body that is being read, found by name.
struct UsdPropertyTable {
    std::vector<UsdProperty>& properties;
    UsdNameIndex& index;
};

/// Reads one statement: a declaration, value, timeSamples, connection, relationship or (skipped
/// with a warning; format 1.1 only) spline. Statements about one name add up; the last value wins;
/// another type under the same name is an error. \param owner absolute path of the prim, for
/// relative paths
void parseUsdProperty(UsdScanner& scanner, const UsdPropertyTable& table, const std::string& owner,
                      int formatMinor, Diagnostics& diagnostics);

} // namespace penumbra
