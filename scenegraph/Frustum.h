// What a view can see of a box.
#pragma once

#include "base/Bounds.h"

#include <glm/glm.hpp>

#include <array>

namespace penumbra {

/// The six planes of a view volume, taken from a clip matrix (Gribb & Hartmann 2001).
class Frustum {
public:
    /// \param worldToClip OpenGL clip space: -w <= x, y, z <= w
    explicit Frustum(const glm::dmat4& worldToClip);

    /// False only if the box is certainly outside: it is wholly behind one of the planes.
    bool mayContain(const Bounds& box) const;

private:
    std::array<glm::dvec4, 6> planes_; ///< n . p + d >= 0 inside
};

} // namespace penumbra
