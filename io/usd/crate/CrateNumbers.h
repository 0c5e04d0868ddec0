// Numbers, tuples, matrices and arrays of them.
#pragma once

#include "io/usd/crate/CrateFile.h"
#include "io/usd/layer/UsdValue.h"

namespace penumbra {

/// The value of a representation whose type has numbers (bool to quath, vectors, timecode). Throws
/// CrateFault.
UsdValue crateNumbers(CrateFile& file, CrateRep rep);

/// The array's elements, of which nothing is known but their smallest size, follow behind the
/// returned count. \param in behind the array's offset
std::uint64_t takeCrateArrayCount(CrateBytes& in, CrateVersion version, std::uint64_t itemBytes);

/// A half (1 sign, 5 exponent, 10 mantissa bits) as float.
float floatOfHalf(std::uint16_t half);

} // namespace penumbra
