// What leaves a sender of indirect light, and what of it arrives.
#pragma once

#include "radiosity/rows/Row.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

namespace penumbra {

/// What leaves the cells of a sender [lm/m^2]:
///
///     of one that sends evenly   1
///     of a patch                 16, around its samples, those of a quarter one after the other
///     of a cluster               16 + 4: by how much more direct light leaves the place of each of
///                                its samples than its quarter in the mean; and the quarters' means
using SenderLight = std::span<const glm::dvec3>;

inline constexpr std::size_t kSenderCells = 16, kClusterCells = kSenderCells + 4;

/// Largest channel, whatever its sign.
inline double largest(glm::dvec3 v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

inline double largest(SenderLight light) {
    double most = 0;
    for (const glm::dvec3& cell : light) most = std::max(most, largest(cell));
    return most;
}

/// Mean over cells.
inline glm::dvec3 meanOf(SenderLight light) {
    glm::dvec3 sum(0);
    for (const glm::dvec3& cell : light) sum += cell;
    return sum / double(light.size());
}

/// Mean over kUpTo + 1 parts.
/// \param upTo how much the first, the first two, ... are, of 255
template <std::size_t kUpTo, class Part>
glm::dvec3 meanOfParts(const std::uint8_t* upTo, const Part& part) {
    glm::dvec3 sum(0);
    int before = 0;
    for (std::size_t k = 0; k < kUpTo; ++k) {
        sum += double(upTo[k] - before) * part(k);
        before = upTo[k];
    }
    return (sum + double(255 - before) * part(kUpTo)) * (1.0 / 255);
}

/// What an entry sees of a sender: a mean over its cells.
inline glm::dvec3 seenLight(SenderLight light, RowBlock::Shares shares) {
    if (shares.bytes.empty()) return light[0];
    const std::uint8_t* const bytes = shares.bytes.data();
    const bool cluster = light.size() == kClusterCells;
    const auto quarter = [&](std::size_t q) {
        return cluster ? light[kSenderCells + q] : glm::dvec3(0);
    };
    const std::uint8_t which = bytes[0];
    switch (shares.samples) {
    case 1:
        return light[which] + (cluster ? meanOfParts<3>(bytes + 1, quarter) : glm::dvec3(0));
    case 4:
        return meanOfParts<3>(bytes + 1, [&](std::size_t q) {
            return light[4 * q + (which >> 2 * q & 3)] + quarter(q);
        });
    default:
        return meanOfParts<15>(bytes, [&](std::size_t k) { return light[k] + quarter(k / 4); });
    }
}

/// Calls visit(receiver, form factor times visibility, what that makes of `light`).
template <class Visit>
void forEachReceived(const RowBlock& block, SenderLight light, const Visit& visit) {
    if (block.sharing() == RowBlock::Sharing::even) {
        block.forEach([&](int r, float factor) { visit(r, factor, double(factor) * light[0]); });
        return;
    }
    block.forEachShared([&](int r, float factor, RowBlock::Shares shares) {
        visit(r, factor, double(factor) * seenLight(light, shares));
    });
}

} // namespace penumbra
