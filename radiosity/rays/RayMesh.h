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
    /// Which sides of a triangle are lit, see Sides. Empty: both of all.
    std::vector<std::uint8_t> lit;
    /// Of its object: of triangles in one place a ray meets that of the least key.
    std::uint64_t key = 0;
};

/// Of a triangle, as bits: its front, where its corners go round counter-clockwise, and its back.
enum Sides : std::uint8_t { kNoSide = 0, kFront = 1, kBack = 2, kBothSides = 3 };

} // namespace penumbra
