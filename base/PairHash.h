// A hash of two numbers.
#pragma once

#include <cstdint>

namespace penumbra {

/// Mixes two numbers into one that looks random.
inline std::uint32_t pairHash(std::uint32_t a, std::uint32_t b) {
    std::uint32_t h = a * 0x9e3779b1u ^ (b + 0x7f4a7c15u) * 0x85ebca77u;
    h ^= h >> 15, h *= 0x2c1b3c6du;
    h ^= h >> 12, h *= 0x297a2d39u;
    return h ^ h >> 15;
}

} // namespace penumbra
