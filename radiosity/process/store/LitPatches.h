// The patches of a mesh that came from the worker, for those who trace rays beside it.
#pragma once

#include "radiosity/mesh/PatchSet.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace penumbra {

/// What rays and contacts need of the worker's PatchSet: objects, vertices with their receivers,
/// elements by patches, and triangles for rays, all in the same order and with the same values. It
/// has no nodes, colours or emitters. Objects are absent, and lie in frames of their own: see
/// PosedPatches::pose().
///
/// \param meshes as describeMesh() wrote them, or anything else: the first, and what came to it
/// \param blocks vertices are there for as many
/// \return      none: this is no mesh
std::optional<PatchSet> readPatches(std::span<const std::span<const std::byte>> meshes,
                                    std::uint32_t blocks);

} // namespace penumbra
