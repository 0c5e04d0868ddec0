// What is still to be done about the light of a block of vertices, for those who want to see it.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

namespace penumbra {

/// Why one block is dirty, as the solver sees it; of several reasons the one that is last in this
/// list.
struct DirtyStatus {
    enum class Kind : std::uint8_t {
        none,     ///< its light is as it will stay, as far as anybody knows
        deferred, ///< lights: what it may change is within the tolerance of the picture
        patches,  ///< rows of patches that light it
        coming,   ///< its direct light was worked on, and is about to be summed and published
        lights    ///< rows of emitters
    };
    Kind kind = Kind::none;
    std::uint8_t rows = 0; ///< of emitters for which it is dirty, 255: so many or more
    /// The highest priority of its work, see priorityOf(); >= 0. With the policy `importance`:
    /// visible steps of luminance, times pixels, per ray.
    float priority = 0;

    /// One word, which nobody reads torn.
    std::uint64_t packed() const {
        return std::bit_cast<std::uint32_t>(priority) | std::uint64_t(kind) << 32 |
               std::uint64_t(rows) << 40;
    }
    /// What makes no sense reads as nothing.
    static DirtyStatus unpacked(std::uint64_t word) {
        DirtyStatus work;
        const auto kind = std::uint8_t(word >> 32);
        if (kind > std::uint8_t(Kind::lights)) return work;
        work.kind = Kind(kind);
        work.rows = std::uint8_t(word >> 40);
        work.priority = std::bit_cast<float>(std::uint32_t(word));
        if (!(work.priority >= 0) || !std::isfinite(work.priority)) work.priority = 0;
        return work;
    }
    friend bool operator==(const DirtyStatus&, const DirtyStatus&) = default;
};

} // namespace penumbra
