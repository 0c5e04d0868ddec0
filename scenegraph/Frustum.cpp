// After G. Gribb & K. Hartmann, "Fast extraction of viewing frustum planes from the
// world-view-projection matrix", 2001.
#include "scenegraph/Frustum.h"

namespace penumbra {

Frustum::Frustum(const glm::dmat4& worldToClip) {
    const glm::dmat4 rows = glm::transpose(worldToClip);
    for (int axis = 0; axis < 3; ++axis) {
        planes_[2 * axis] = rows[3] + rows[axis];
        planes_[2 * axis + 1] = rows[3] - rows[axis];
    }
}

bool Frustum::mayContain(const Bounds& box) const {
    if (box.empty()) return false;
    for (const glm::dvec4& plane : planes_) {
        const glm::dvec3 normal(plane);
        glm::dvec3 farthest; // the corner farthest along the plane's normal
        for (int axis = 0; axis < 3; ++axis)
            farthest[axis] = normal[axis] >= 0 ? box.upper[axis] : box.lower[axis];
        if (glm::dot(normal, farthest) + plane.w < 0) return false;
    }
    return true;
}

} // namespace penumbra
