#include "radiosity/mesh/Pose.h"

#include <algorithm>
#include <cmath>

namespace penumbra {

namespace {

double largestEntry(const glm::dmat3& m) {
    double most = 0;
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r) most = std::max(most, std::abs(m[c][r]));
    return most;
}

/// Rounds to multiples of the 2^30th part of the power of two above the largest entry.
glm::dmat3 rounded(glm::dmat3 m) {
    const double most = largestEntry(m);
    if (most == 0) return m;
    // A hair more than the entry itself, so that 1 - 1e-16 and 1 + 1e-16 share their exponent.
    const double unit = std::ldexp(1.0, std::ilogb(most * (1 + 1e-9)) - 30);
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r) m[c][r] = std::round(m[c][r] / unit) * unit;
    return m;
}

} // namespace

Placement placementOf(const glm::dmat4& toWorld) {
    Placement placement;
    placement.pose.translation = glm::dvec3(toWorld[3]);
    const glm::dmat3 linear(toWorld);
    const double determinant = glm::determinant(linear);
    const double size = largestEntry(linear);
    if (!(std::abs(determinant) > 1e-12 * size * size * size)) {
        placement.stretch = linear;
        return placement;
    }
    glm::dmat3 rotation = linear;
    for (int i = 0; i < 60; ++i) {
        const glm::dmat3 next = 0.5 * (rotation + glm::transpose(glm::inverse(rotation)));
        const double change = largestEntry(next - rotation);
        rotation = next;
        if (change < 1e-15) break;
    }
    if (determinant < 0) rotation = -rotation;
    const glm::dmat3 stretch = glm::transpose(rotation) * linear;
    placement.stretch = rounded(0.5 * (stretch + glm::transpose(stretch)));
    placement.pose.rotation = rotation;
    // Keep files that only place their objects exactly as they are written.
    if (placement.stretch == glm::dmat3(1.0)) placement.pose.rotation = linear;
    return placement;
}

} // namespace penumbra
