// Scenes with arcs at random, most of them nonsense.
#pragma once

#include "tests/io/usd/UsdTestFiles.h"

namespace penumbra {

/// Writes layers of few names and many arcs among them; the root layer is 0.usda.
void writeRandomLayers(const TemporaryFolder& folder, unsigned seed);

} // namespace penumbra
