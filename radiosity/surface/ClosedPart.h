// What a closed surface has inside.
#pragma once

#include "base/Bounds.h"

#include <glm/glm.hpp>

#include <array>
#include <span>
#include <vector>

namespace penumbra {

/// A closed connected part of a mesh, in triangles, its lid included.
struct ClosedPart {
    Bounds bounds;
    std::vector<std::array<glm::vec3, 3>> triangles;

    /// Whether a ray from one of the points leaves the part an odd number of times. Linear in
    /// triangles and points where both are dense.
    bool containsAny(std::span<const glm::vec3> points) const;
};

} // namespace penumbra
