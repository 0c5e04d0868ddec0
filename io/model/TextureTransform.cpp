#include "io/model/TextureTransform.h"

#include <cmath>

namespace penumbra {

// With s = u and t = 1 - v, u' = su cos(r) s - sv sin(r) t + sv sin(r) + ou is a counter-clockwise
// turn by r and a shift, and so is t' = 1 - v' = su sin(r) s + sv cos(r) t + 1 - sv cos(r) - ov.
std::optional<UsdTextureTransform> usdTransformOf(const GltfTextureTransform& gltf) {
    constexpr double kMost = 1e6;
    for (const double number :
         {gltf.offset.x, gltf.offset.y, gltf.scale.x, gltf.scale.y, gltf.rotation})
        if (!(std::abs(number) <= kMost)) return std::nullopt;
    const double c = std::cos(gltf.rotation), s = std::sin(gltf.rotation);
    return UsdTextureTransform{
        gltf.scale,
        glm::degrees(gltf.rotation),
        {gltf.scale.y * s + gltf.offset.x, 1 - gltf.scale.y * c - gltf.offset.y}};
}

} // namespace penumbra
