// What leaves a sender of indirect light, and what of it arrives.
#pragma once

#include "base/Wide.h"
#include "radiosity/rows/Row.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
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

/// What leaves a sender, as its entries read it: what an entry sees is a mean over cells.
class SentLight {
public:
    explicit SentLight(SenderLight light) : first_(light[0]) {
        if (light.size() == 1) return;
        const bool cluster = light.size() == kClusterCells;
        const auto quarter = [&](std::size_t q) {
            return cluster ? wide(light[kSenderCells + q]) : Wide{};
        };
        for (std::size_t k = 0; k < kSenderCells; ++k) {
            cells_[k] = wide(light[k]) + quarter(k / 4);
            alone_[k] = wide(light[k]) + quarter(3);
        }
        for (std::size_t k = 0; k < cellSteps_.size(); ++k)
            cellSteps_[k] = (cells_[k] - cells_[k + 1]) * kShare;
        for (std::size_t q = 0; q < quarterSteps_.size(); ++q)
            quarterSteps_[q] = (quarter(q) - quarter(q + 1)) * kShare;
    }

    const glm::dvec3& first() const { return first_; } ///< of a sender that sends evenly, all

    /// What an entry sees. With u_k how much the first k + 1 cells are, and u_15 = 1, the mean
    /// sum (u_k - u_(k-1)) cell_k is cell_15 + sum u_k (cell_k - cell_(k+1)). \pre there are cells
    glm::dvec3 seen(RowBlock::Shares shares) const {
        const std::uint8_t* const bytes = shares.bytes.data();
        if (shares.samples == 1) {
            Wide sum = alone_[bytes[0]];
            if (shares.bytes.size() > 1)
                for (std::size_t q = 0; q < quarterSteps_.size(); ++q)
                    sum += double(bytes[1 + q]) * quarterSteps_[q];
            return narrow(sum);
        }
        if (shares.samples == 4) {
            std::array<Wide, 4> cell;
            for (std::size_t q = 0; q < 4; ++q) cell[q] = cells_[4 * q + (bytes[0] >> 2 * q & 3)];
            Wide sum{};
            for (std::size_t q = 0; q < 3; ++q)
                sum += double(bytes[1 + q]) * (cell[q] - cell[q + 1]);
            return narrow(cell[3] + sum * kShare);
        }
        Wide sum = cells_.back();
        for (std::size_t k = 0; k < cellSteps_.size(); ++k) sum += double(bytes[k]) * cellSteps_[k];
        return narrow(sum);
    }

private:
    using Wide = Double4; ///< red, green, blue and nothing: relaxation spends its time here
    static constexpr double kShare = 1.0 / 255;

    static Wide wide(glm::dvec3 v) { return Wide{v.x, v.y, v.z, 0}; }
    static glm::dvec3 narrow(const Wide& v) { return {v[0], v[1], v[2]}; }

    glm::dvec3 first_;
    std::array<Wide, kSenderCells> cells_, alone_; ///< with their own quarter; with the last one
    std::array<Wide, kSenderCells - 1> cellSteps_; ///< from cell to cell, by 255
    std::array<Wide, 3> quarterSteps_;             ///< likewise, of a cluster
};

/// Calls visit(receiver, form factor times visibility, what that makes of `light`).
template <class Visit>
void forEachReceived(const RowBlock& block, const SentLight& light, const Visit& visit) {
    if (!RowBlock::hasShares(block.sharing())) {
        block.forEach(
            [&](int r, float factor) { visit(r, factor, double(factor) * light.first()); });
        return;
    }
    block.forEachShared([&](int r, float factor, RowBlock::Shares shares) {
        visit(r, factor, double(factor) * light.seen(shares));
    });
}

} // namespace penumbra
