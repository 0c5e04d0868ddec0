// Unoccluded form factors of a sender's parts to a receiver, all of them at once.
#pragma once

#include "radiosity/mesh/PatchSet.h"
#include "radiosity/rows/ClusterParts.h"

#include <array>
#include <cstdint>
#include <span>

namespace penumbra {

/// Unoccluded form factors of a sender's parts, in order; each quarter of them represents a quarter
/// of the sender.
struct PartKernels {
    std::uint32_t begin(std::uint32_t group, std::uint32_t groups) const {
        return group * count / groups;
    }
    float sum(std::uint32_t first, std::uint32_t last) const {
        float sum = 0;
        for (std::uint32_t k = first; k < last; ++k) sum += part[k];
        return sum;
    }
    std::uint32_t count = 0;
    float total = 0;
    std::array<float, kPatchSamples> part{};
};

/// The parts of a sender, coordinate by coordinate: so they are evaluated eight at a time, with the
/// very numbers that one at a time would give.
class PartTable {
public:
    /// How a part sends: as a disk of its area does, see partFormFactor(), or as a point does.
    enum class Kernel : std::uint8_t { disk, point };

    /// \pre no more parts than kPatchSamples
    void load(std::span<const SenderPart> parts, Kernel kernel);
    PartKernels kernels(const Receiver& receiver) const;

private:
    using Lanes = std::array<float, kPatchSamples>;

    std::uint32_t count_ = 0;
    Kernel kernel_ = Kernel::disk;
    Lanes x_{}, y_{}, z_{}; ///< centres [m, world]
    Lanes normalX_{}, normalY_{}, normalZ_{};
    Lanes area_{}; ///< [m^2]
};

} // namespace penumbra
