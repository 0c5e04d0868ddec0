// Polygons into triangles.
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace penumbra {

/// Whether a polygon, seen along its Newell normal, turns the same way at every corner and turns
/// round once: then a fan around any inner point covers it.
bool isConvex(std::span<const glm::vec3> points, std::span<const std::uint32_t> corners);

/// Cuts a simple polygon, concave or not quite planar, into triangles by clipping ears in the plane
/// of its Newell normal (Meisters 1975). Of a polygon that crosses itself something is returned.
/// Quadratic in the number of corners.
std::vector<std::array<std::uint32_t, 3>> triangulate(std::span<const glm::vec3> points,
                                                      std::span<const std::uint32_t> corners);

} // namespace penumbra
