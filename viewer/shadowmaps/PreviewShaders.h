// The text of the shader that previews lights, GLSL 3.30; see PreviewLighting.
#pragma once

#include "viewer/preview/PreviewLighting.h"

#include <string>

namespace penumbra {

/// The change of the light is worked out vertex by vertex, where radiosity has its light: by pixels
/// the shadows would be finer than those that they are exchanged for, and each edge of a shadow
/// would change its sharpness when a thing is taken hold of and when it is let go. For
/// screenFragmentShader().
std::string previewVertexShader();

/// The table of uniforms that the shader reads: a row of texels a light and scene state; row
/// kPreviewRows * slot + light with slot 0 for now, 1 ... 3 for the anchors.
///
///     0            kind (PreviewKind), cube views or not, -, -
///     1 ... 4      corners; or centre and radius, axis
///     5, 6         spheres around the light, and around what moves: centre, radius
///     7, 8, 9      right and up axis of the maps; axis and texel's width at distance 1
///     10           unit normal of the light, or zero; layer of the maps
///     11           depth of the maps of what moves: a, b; of what does not: a, b
///     12 + 2 k     point k, scale x;  13 + 2 k: scale y, offset x, offset y
enum class PreviewKind { none, quad, disk, sphere };
constexpr int kPreviewRows = int(kMostPreviewedByMaps);
constexpr int kPreviewColumns = 12 + 2 * 16;
constexpr int kPreviewSlots = 4;

} // namespace penumbra
