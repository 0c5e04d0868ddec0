// Points at exactly the same position, as one.
#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace penumbra {

/// For every point the index of the first one at its position. Points that lie close are left
/// apart: a tolerance would tear dense meshes where it closes others.
std::vector<std::uint32_t> weldPoints(std::span<const glm::vec3> points);

/// A hash of a position, the same for 0 and -0.
std::uint64_t positionHash(glm::vec3 p);

/// Mixes a number into a hash.
std::uint64_t mixHash(std::uint64_t hash, std::uint64_t number);

} // namespace penumbra
