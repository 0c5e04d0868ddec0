#include "radiosity/surface/WeldedPoints.h"

#include <bit>

namespace penumbra {

std::uint64_t mixHash(std::uint64_t hash, std::uint64_t number) {
    // The finaliser of SplitMix64 (Steele, Lea & Flood 2014).
    std::uint64_t h = hash + number + 0x9e3779b97f4a7c15u;
    h = (h ^ h >> 30) * 0xbf58476d1ce4e5b9u;
    h = (h ^ h >> 27) * 0x94d049bb133111ebu;
    return h ^ h >> 31;
}

std::uint64_t positionHash(glm::vec3 p) {
    const auto bits = [](float x) { return std::uint64_t(std::bit_cast<std::uint32_t>(x + 0.0f)); };
    return mixHash(bits(p.x) << 32 | bits(p.y), bits(p.z));
}

std::vector<std::uint32_t> weldPoints(std::span<const glm::vec3> points) {
    constexpr std::uint32_t kFree = 0xffffffffu;
    // A table of open addresses, at most half full.
    const std::size_t mask = std::bit_ceil(2 * points.size() + 1) - 1;
    std::vector<std::uint32_t> table(mask + 1, kFree);
    std::vector<std::uint32_t> first(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        std::size_t slot = positionHash(points[i]) & mask;
        while (table[slot] != kFree && points[table[slot]] != points[i]) slot = (slot + 1) & mask;
        if (table[slot] == kFree) table[slot] = std::uint32_t(i);
        first[i] = table[slot];
    }
    return first;
}

} // namespace penumbra
