// What rays can meet of one object.
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace penumbra {

/// Triangles of one object for tracing rays.
struct RayMesh {
    std::vector<glm::vec3> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    /// 1 for triangles of a closed surface with nothing lit inside, wound so that its outside is
    /// the front: a ray that meets it from behind began inside of something solid.
    std::vector<std::uint8_t> solid;
};

} // namespace penumbra
