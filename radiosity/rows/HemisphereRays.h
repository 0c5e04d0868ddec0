// A fixed bundle of rays over the hemisphere.
#pragma once

#include "base/Frame.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace penumbra {

/// Directions of equal weight for cosine-weighted means over a hemisphere, well spread, every
/// prefix of 4, 16, 64 ... too. The same for every point of the same normal, so that what is
/// sampled with them varies smoothly from point to point.
class HemisphereRays {
public:
    explicit HemisphereRays(int count);
    int count() const { return int(local_.size()); }
    /// Direction `index` around a unit normal, unit length.
    glm::vec3 direction(int index, glm::vec3 normal) const;
    glm::vec3 direction(int index, const Frame& frame) const; ///< around the normal of a frame
    /// Directions around a unit normal that may pass a sphere, at least all that do, as bits.
    /// \param away the sphere's centre, seen from where the rays begin \pre count() <= 64
    std::uint64_t towards(glm::vec3 away, float radius, glm::vec3 normal) const;

private:
    std::vector<glm::vec3> local_; ///< around +Z
};

} // namespace penumbra
