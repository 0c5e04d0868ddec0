// Vectors of Assimp as ours.
#pragma once

#include <glm/glm.hpp>

namespace penumbra {

/// \param v an aiVector3D, which only .cpp files know
template <class Vector>
glm::dvec3 vectorOf(const Vector& v) {
    return {double(v.x), double(v.y), double(v.z)};
}

} // namespace penumbra
