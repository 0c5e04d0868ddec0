// A layer as USD text.
#pragma once

#include "io/usd/layer/UsdLayer.h"

#include <string>

namespace penumbra {

/// All that a layer says, in its own order: read back, the text gives the same layer. The text's
/// form is OpenUSD's own: an item of metadata a line, a blank line between prims, braces on lines
/// of their own.
std::string usdLayerText(const UsdLayer& layer);

} // namespace penumbra
