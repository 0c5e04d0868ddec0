// What differs between two layers, whatever files they come from.
#pragma once

#include "io/usd/layer/UsdLayer.h"

#include <string>

namespace penumbra {

/// The first difference of two layers, as `</a/b.c> default: 1 | 2`; empty if they say the same.
/// The order of prims, properties and variants counts; that of metadata and of the kinds of list
/// edits means nothing and doesn't; nor do positions and file names. NaN equals NaN.
std::string differenceOf(const UsdLayer& a, const UsdLayer& b);

} // namespace penumbra
