// How many rays have been traced.
#pragma once

#include <cstdint>

namespace penumbra {

/// Rays that were traced.
struct RayCount {
    std::uint64_t full = 0;   ///< against the whole scene
    std::uint64_t single = 0; ///< against one object
    std::uint64_t total() const { return full + single; }
    RayCount& operator+=(const RayCount& other) {
        full += other.full;
        single += other.single;
        return *this;
    }
    friend RayCount operator-(RayCount a, const RayCount& b) {
        return {a.full - b.full, a.single - b.single};
    }
};

} // namespace penumbra
