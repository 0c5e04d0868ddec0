// Segments that are tested for obstacles together.
#pragma once

#include "base/Bounds.h"
#include "base/ObjectId.h"

#include <glm/glm.hpp>

#include <cstdint>

namespace penumbra {

/// Up to 16 segments to be tested for obstacles. Segment i runs from its origin to origin +
/// direction.
struct alignas(64) ShadowRays {
    static constexpr int kMost = 16;
    float originX[kMost], originY[kMost], originZ[kMost];
    float directionX[kMost], directionY[kMost], directionZ[kMost];
    std::uint32_t used = 0; ///< bit i: segment i is to be tested
    std::uint32_t
        blocker[kMost]; ///< result: object that blocks the segment, ObjectId::kNone if free

    void set(int i, glm::vec3 origin, glm::vec3 target) {
        originX[i] = origin.x, originY[i] = origin.y, originZ[i] = origin.z;
        directionX[i] = target.x - origin.x;
        directionY[i] = target.y - origin.y;
        directionZ[i] = target.z - origin.z;
        used |= 1u << i;
    }
};

/// Those of some segments (bits) that meet a box.
std::uint32_t lanesThatMeet(const ShadowRays& rays, std::uint32_t lanes, const Bounds& box);

} // namespace penumbra
