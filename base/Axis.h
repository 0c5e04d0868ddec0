// Which of the coordinate axes.
#pragma once

#include <glm/glm.hpp>

namespace penumbra {

/// The axis on which a vector of no negative component is longest, 0 ... 2; of equal ones the
/// first.
template <class Vector>
int longestAxis(const Vector& size) {
    return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
}

} // namespace penumbra
