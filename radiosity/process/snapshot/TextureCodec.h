// Textures of materials as bytes, and back again without trusting them.
#pragma once

#include "radiosity/process/memory/Bytes.h"
#include "scenegraph/Material.h"

#include <span>
#include <vector>

namespace penumbra {

/// What pictures take in a snapshot, at most [bytes]. Beyond it the largest ones are sent coarser:
/// means over patches then come from coarser texels, what is drawn does not.
constexpr std::size_t kMostTextureBytes = std::size_t(96) << 20;

/// Writes each picture once, at full resolution if they fit.
void writeTextures(ByteWriter& out, std::span<const MaterialTextures> materials,
                   std::size_t mostBytes = kMostTextureBytes);
/// \return one a material; `in` has failed if they make no sense
std::vector<MaterialTextures> readTextures(ByteReader& in, std::size_t materials);

} // namespace penumbra
