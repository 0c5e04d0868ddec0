// Where a texture of glTF is on a surface: KHR_texture_transform as UsdTransform2d.
#pragma once

#include <glm/glm.hpp>

#include <optional>

namespace penumbra {

/// What glTF does to texture coordinates (u, v), whose v points down:
///
///     u' =  su cos(r) u + sv sin(r) v + ou
///     v' = -su sin(r) u + sv cos(r) v + ov
///
/// s is the scale, r the rotation [rad], o the offset (KHR_texture_transform). The matrix is that
/// of Khronos's own viewer.
struct GltfTextureTransform {
    glm::dvec2 offset{0}, scale{1};
    double rotation = 0; ///< [rad], counter-clockwise as the picture is seen

    friend bool operator==(const GltfTextureTransform&, const GltfTextureTransform&) = default;
};

/// What UsdTransform2d does to texture coordinates (s, t), whose t points up: they are scaled, then
/// turned counter-clockwise around (0, 0), then shifted.
struct UsdTextureTransform {
    glm::dvec2 scale{1};
    double rotation = 0; ///< [degrees]
    glm::dvec2 translation{0};
};

/// The same transform of the same picture: s = u and t = 1 - v, before as after. Nothing where it
/// has numbers that are no use: not finite, or beyond 1e6.
std::optional<UsdTextureTransform> usdTransformOf(const GltfTextureTransform& gltf);

} // namespace penumbra
