#include "radiosity/rays/ShadowRays.h"

namespace penumbra {

std::uint32_t lanesThatMeet(const ShadowRays& rays, std::uint32_t lanes, const Bounds& box) {
    float first[16], last[16];
    for (int i = 0; i < 16; ++i) first[i] = 0, last[i] = 1;
    const auto clip = [&](const float* origin, const float* direction, float lower, float upper) {
        for (int i = 0; i < 16; ++i) {
            const float inverse = 1.0f / direction[i];
            const float a = (lower - origin[i]) * inverse, b = (upper - origin[i]) * inverse;
            const float near = a < b ? a : b, far = a < b ? b : a;
            first[i] = near > first[i] ? near : first[i]; // not a number: changes nothing
            last[i] = far < last[i] ? far : last[i];
        }
    };
    clip(rays.originX, rays.directionX, box.lower.x, box.upper.x);
    clip(rays.originY, rays.directionY, box.lower.y, box.upper.y);
    clip(rays.originZ, rays.directionZ, box.lower.z, box.upper.z);
    std::uint32_t meet = 0;
    for (int i = 0; i < 16; ++i) meet |= std::uint32_t(first[i] <= last[i]) << i;
    return meet & lanes;
}

} // namespace penumbra
