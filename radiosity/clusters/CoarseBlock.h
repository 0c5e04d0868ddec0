// Some points of a block, from which the others can be guessed.
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace penumbra {

/// Up to 64 points of surfaces, of which those are *chosen* that have no other near them that is
/// chosen and turned the same way: near is a quarter of the block. All others lie beside one or two
/// of these.
struct CoarseBlock {
    static constexpr std::size_t kMost = 64;

    std::uint64_t chosen = 0;                                ///< a bit each
    std::array<std::uint8_t, kMost> nearest{}, secondNear{}; ///< that are chosen; may be the same
    std::array<float, kMost> share{};                        ///< of the nearest, in [0.5, 1]

    /// What a point has when this is so at those that are chosen.
    template <class Values>
    auto guess(const Values& values, std::size_t point) const {
        return share[point] * values[nearest[point]] +
               (1 - share[point]) * values[secondNear[point]];
    }
};

/// \param positions all of one frame, of any unit \param normals as long, of length 1
/// \param valid bits: points that there are; none of the others is chosen
CoarseBlock coarseBlock(std::span<const glm::vec3> positions, std::span<const glm::vec3> normals,
                        std::uint64_t valid = ~std::uint64_t(0));

} // namespace penumbra
