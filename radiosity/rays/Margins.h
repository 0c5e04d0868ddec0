// Every length below which this program takes two things for one.
#pragma once

#include "base/Bounds.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>

namespace penumbra {

// Margins follow where a thing is and how finely it is cut, never how large the scene is: a thing
// that is added or taken far away changes none of them.

/// Largest coordinate of a point [m].
inline float magnitude(glm::vec3 p) {
    return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
}
/// Of all points of a box; 0 if it is empty [m].
inline float magnitude(const Bounds& box) {
    return box.empty() ? 0.0f : std::max(magnitude(box.lower), magnitude(box.upper));
}

/// How far apart two computed points may lie that should be one [m].
///
///     16 u m,    u = 2^-24
///
/// Rounding a coordinate of at most m moves it by u m at most, a point by sqrt(3) u m. A receiver
/// is rounded some four times (corner, point between corners, pull inwards, lift), the triangle
/// under it once more: less than 10 u m in all. A micrometre at 1 m, a millimetre at 1 km.
inline float roundingAt(float magnitude) {
    return 0x1p-20f * magnitude;
}

/// How far receivers hover over their surface, at least [m]: a 4000th of a patch's edge a. A
/// quadrilateral counts as flat, and is traced as two triangles, if its corners are off their plane
/// by up to 1e-4 of its diagonal (SurfaceRays.cpp: planar()). Its corners then may be off by
/// twice that from a plane through three of them, and the triangles by a quarter of this, 0.7e-4 a,
/// from the bilinear surface that the receivers lie on.
inline float skinOf(float patchSize) {
    return 2.5e-4f * patchSize;
}

/// How far a receiver hovers at a point [m]. \param skin see skinOf() \param magnitude of the point
inline float hoverAt(float skin, float magnitude) {
    return std::max(skin, roundingAt(magnitude));
}
inline float hoverAt(float skin, glm::vec3 place) {
    return hoverAt(skin, magnitude(place));
}

/// How far before a point on a surface a segment has to end, at least, so as not to run into that
/// surface [m]: both its sides, as far as a receiver may be off it.
/// \param magnitude of the segment's ends
inline float clearanceAt(float skin, float magnitude) {
    return 2 * hoverAt(skin, magnitude);
}

/// How far beside a triangle a ray may pass and yet count as meeting it [m]: RayScene asks up to
/// three hairs of roundingAt() aside, with rays another hair around. \param magnitude of all that
/// the ray may begin at or meet
inline float strayAt(float magnitude) {
    return 10 * roundingAt(magnitude);
}

} // namespace penumbra
