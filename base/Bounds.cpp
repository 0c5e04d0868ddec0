// After J. Arvo, "Transforming axis-aligned bounding boxes", Graphics Gems, 1990.
#include "base/Bounds.h"

namespace penumbra {

Bounds transformed(const Bounds& box, const glm::dmat4& matrix) {
    if (box.empty()) return box;
    glm::dvec3 lower(matrix[3]);
    glm::dvec3 upper = lower;
    for (int column = 0; column < 3; ++column) {
        const glm::dvec3 a = glm::dvec3(matrix[column]) * double(box.lower[column]);
        const glm::dvec3 b = glm::dvec3(matrix[column]) * double(box.upper[column]);
        lower += glm::min(a, b);
        upper += glm::max(a, b);
    }
    return {glm::vec3(lower), glm::vec3(upper)};
}

} // namespace penumbra
