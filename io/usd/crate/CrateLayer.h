// A crate file (binary USD, `.usdc`) as a layer.
#pragma once

#include "io/usd/layer/UsdLayer.h"

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace penumbra {

/// Whether the bytes begin as a crate file does.
bool isCrate(std::string_view begin);

/// Reads a crate file of version 0.0 to 0.14 as the layer that its text would give. Throws
/// SceneFileError with the byte where the file can't be understood; single fields and specs that
/// can't be read are left out with a warning. Nothing in the file is believed: offsets, counts and
/// sizes are checked, and what is made of it stays in proportion to its size.
/// \param bytes the whole file; not kept
/// \param file  the name that errors and warnings carry
UsdLayer readCrateLayer(std::span<const std::byte> bytes, const std::string& file,
                        const UsdLayerLimits& limits = {});

} // namespace penumbra
