// Random numbers, points and frames of a room's size, for RapidCheck.
#pragma once

#include "base/Bounds.h"

#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <rapidcheck.h>

#include <cmath>

namespace penumbra {

/// A number in [lower, upper], in 4096 steps so that RapidCheck can shrink it; drawn from the whole
/// range from the first trial on, not from a range that grows with the trials.
inline double number(double lower, double upper) {
    const int step = *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(0, 4097));
    return lower + (upper - lower) * step / 4096.0;
}

inline glm::vec3 point(double reach = 10) {
    const double x = number(-reach, reach), y = number(-reach, reach), z = number(-reach, reach);
    return glm::vec3(glm::dvec3(x, y, z));
}

inline glm::dvec3 direction() {
    const double azimuth = number(0, 6.28), height = number(-1, 1);
    const double radius = std::sqrt(1 - height * height);
    return {radius * std::cos(azimuth), radius * std::sin(azimuth), height};
}

inline Bounds box() {
    Bounds box;
    box.add(point());
    box.add(point());
    return box;
}

inline glm::dmat4 place() {
    return glm::translate(glm::dmat4(1.0), glm::dvec3(point()));
}

inline glm::dmat4 rotation() {
    return glm::rotate(glm::dmat4(1.0), number(0, 6.28), direction());
}

/// Scale along the axes, mirrored at times.
inline glm::dmat4 scale() {
    glm::dvec3 factors(number(0.1, 3), number(0.1, 3), number(0.1, 3));
    if (*rc::gen::arbitrary<bool>()) factors.x = -factors.x;
    return glm::scale(glm::dmat4(1.0), factors);
}

/// Any affine frame: axes neither unit nor orthogonal.
inline glm::dmat4 frame() {
    return place() * scale() * rotation();
}

/// A frame whose axes are orthogonal, as a camera needs; they may be scaled.
inline glm::dmat4 orthogonalFrame() {
    return place() * rotation() * scale();
}

} // namespace penumbra
