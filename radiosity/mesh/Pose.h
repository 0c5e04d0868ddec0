// Where a rigid object is, separate from how its frame is scaled.
#pragma once

#include <glm/glm.hpp>

namespace penumbra {

/// A rigid motion: p_world = rotation * p + translation, reckoned in double precision.
struct Pose {
    glm::dmat3 rotation{1.0};
    glm::dvec3 translation{0.0}; ///< [m]

    glm::vec3 point(glm::vec3 p) const { return glm::vec3(rotation * glm::dvec3(p) + translation); }
    glm::vec3 direction(glm::vec3 d) const { return glm::vec3(rotation * glm::dvec3(d)); }
    /// From the world back to the frame that this pose places.
    glm::vec3 inverse(glm::vec3 p) const {
        return glm::vec3(glm::transpose(rotation) * (glm::dvec3(p) - translation));
    }
    friend bool operator==(const Pose&, const Pose&) = default;
};

/// A frame as a rigid motion after a stretch: p_world = rotation * (stretch * p_object) +
/// translation. Geometry is meshed in the stretched frame, so that a rigid motion changes no edge
/// length by as much as a rounding error, and the mesh is the same wherever the object stands.
struct Placement {
    Pose pose;
    glm::dmat3 stretch{1.0}; ///< the same, bit for bit, for all rigid motions of one frame
};

/// Polar decomposition (Higham 1986, Newton's iteration). The stretch is rounded to 30 bits, so
/// that what rounding a motion adds to it is taken off again; a mirroring frame mirrors its
/// stretch. \param toWorld affine, column vectors; a singular one counts as its own stretch
Placement placementOf(const glm::dmat4& toWorld);

} // namespace penumbra
