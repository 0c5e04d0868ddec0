// What a composed scene says, in words: two scenes that say the same have the same description.
#pragma once

#include "io/usd/stage/UsdStage.h"

#include <string>

namespace penumbra {

/// All prims of a stage, and all their properties with what they say, at three times and without
/// one: values, numbers to nine digits; targets; interpolation. Asset paths are left out.
std::string described(const UsdStage& stage);

} // namespace penumbra
